//! Properties of every design on the bench.

use std::collections::BTreeSet;

use proptest::prelude::*;

use crate::app::action::Step;
use crate::app::room::workshop::{Bench, air};
use crate::workshop::{
    Design, DesignFinding, FindingKind, FindingSeverity, Measure, PartSlot, Sheet, parts_for,
};

/// A design built from choices: for each slot the index of a part, or of no part.
fn built(choices: &[usize]) -> Design {
    let mut design = Design::new("any");
    for (slot, choice) in PartSlot::ALL.into_iter().zip(choices) {
        let parts: Vec<_> = parts_for(slot).collect();
        if let Some(part) = parts.get(choice % (parts.len() + 1)) {
            design = design.with(part);
        }
    }
    design
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, ..ProptestConfig::default() })]

    #[test]
    fn a_part_that_fits_leaves_no_fault_in_its_slot_and_brings_none_elsewhere(
        choices in proptest::collection::vec(0usize..1000, 10),
        row in 0usize..10,
    ) {
        let design = built(&choices);
        let before: BTreeSet<_> = faults(&design);
        let mut bench = Bench::default();
        bench.open(design.clone(), None, air());
        for _ in 0..row {
            bench.move_row(Step::Down, air());
        }
        for candidate in bench.candidates() {
            let with = design.with(candidate.part);
            let after = faults(&with);
            let slot = candidate.part.slot();
            let in_slot = after.iter().any(|fault| fault.0 == slot);
            let brings = after.difference(&before).next().is_some();
            if candidate.misfit.is_none() && with != design {
                prop_assert!(!in_slot && !brings, "{}: {:?}", candidate.part.id, after);
            } else if candidate.misfit.is_some() {
                prop_assert!(in_slot || brings, "{}", candidate.part.id);
            }
            let shown = if candidate.on_board > 0 { &design } else { &with };
            prop_assert_eq!(&candidate.sheet, &Sheet::of(shown, air()));
        }
        let first_misfit = bench.candidates().iter().position(|it| it.misfit.is_some());
        let fits_after = |at: usize| bench.candidates()[at..].iter().any(|it| it.misfit.is_none());
        prop_assert!(!first_misfit.is_some_and(fits_after), "misfits come last");
    }

    #[test]
    fn undo_leads_back_to_the_beginning_and_redo_to_the_end(
        choices in proptest::collection::vec(0usize..1000, 10),
        keys in proptest::collection::vec(0usize..4, 1..30),
    ) {
        let design = built(&choices);
        let mut bench = Bench::default();
        bench.open(design.clone(), None, air());
        for key in keys {
            match key {
                0 => bench.move_row(Step::Down, air()),
                1 => bench.move_part(Step::Down, air()),
                2 => {
                    bench.put_in(air());
                }
                _ => {
                    let there = bench.rows()[bench.row()].part;
                    if let Some(part) = there {
                        bench.take_out(part, air());
                    }
                }
            }
        }
        let end = bench.design().clone();
        while bench.undo(air()) {}
        prop_assert_eq!(bench.design(), &design);
        while bench.redo(air()) {}
        prop_assert_eq!(bench.design(), &end);
        prop_assert_eq!(bench.sheet(), &Sheet::of(&end, air()));
        prop_assert!(Measure::Mass.of(bench.sheet()).is_some());
    }
}

fn faults(design: &Design) -> BTreeSet<(PartSlot, FindingKind)> {
    let findings = design.findings(air()).into_iter();
    // A missing part is no reason against another one: a chassis for a drone begins a robot.
    let is_reason = |it: &DesignFinding| {
        it.severity() == FindingSeverity::Fault && it.kind != FindingKind::Missing
    };
    let faults = findings.filter(is_reason);
    faults.map(|it| (it.slot, it.kind)).collect()
}
