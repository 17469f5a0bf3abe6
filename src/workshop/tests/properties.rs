//! Properties of every drone.

use proptest::prelude::*;
use proptest::sample::select;

use super::*;

fn any_part(slot: PartSlot) -> impl Strategy<Value = &'static Part> {
    select(
        parts()
            .filter(|part| part.slot() == slot && part.fits(DesignKind::Drone))
            .collect::<Vec<_>>(),
    )
}

fn any_design() -> impl Strategy<Value = Design> {
    let drive = (
        any_part(PartSlot::Frame),
        any_part(PartSlot::Motor),
        any_part(PartSlot::Propeller),
        any_part(PartSlot::Esc),
        any_part(PartSlot::Battery),
    );
    let rest = proptest::collection::vec(select(parts().collect::<Vec<_>>()), 0..12);
    (drive, rest).prop_map(|((frame, motor, propeller, esc, battery), rest)| {
        let drive = [frame, motor, propeller, esc, battery];
        // The drive is added last and replaces earlier parts in its slots.
        rest.into_iter()
            .chain(drive)
            .fold(Design::new("any"), |design, part| design.with(part))
    })
}

proptest! {
    #[test]
    fn a_design_comes_back_from_its_file_as_it_was(design in any_design()) {
        prop_assert_eq!(Design::from_toml(&design.to_toml()), Ok(design));
    }

    #[test]
    fn what_is_taken_out_again_leaves_no_trace(
        design in any_design(),
        part in select(parts().filter(|part| part.is_load()).collect::<Vec<_>>()),
    ) {
        let more = design.with(part);
        if more != design {
            prop_assert!(more.mass_kg() > design.mass_kg());
            prop_assert_eq!(more.without(part), design);
        }
    }

    #[test]
    fn another_battery_of_the_kind_makes_it_heavier_dearer_and_never_weaker_at_the_current(design in any_design()) {
        let Some(battery) = design.in_slot(PartSlot::Battery).first() else {
            return Ok(());
        };
        let more = design.with(battery);
        prop_assume!(more != design);
        let (one, two) = (design.figures(Air::default()), more.figures(Air::default()));
        let (Some(one), Some(two)) = (one, two) else {
            return Err(TestCaseError::fail("a complete design has figures"));
        };
        prop_assert!(two.mass_kg > one.mass_kg);
        prop_assert!(two.credits > one.credits);
        prop_assert!(two.hover_power_w > one.hover_power_w);
        prop_assert!(two.capacity_ah > one.capacity_ah && two.max_current_a > one.max_current_a);
    }

    #[test]
    fn figures_are_numbers_and_hang_together(design in any_design(), altitude_m in 0.0..4000.0, battery_c in -20.0..40.0) {
        let air = Air { altitude_m, battery_c, ..Air::default() };
        let Some(figures) = design.figures(air) else {
            return Err(TestCaseError::fail("a complete design has figures"));
        };
        prop_assert!(figures.hover_power_w.is_finite() && figures.hover_power_w > 0.0);
        prop_assert!(figures.max_thrust_n.is_finite() && figures.max_thrust_n >= 0.0);
        prop_assert!(figures.hover_time_s >= 0.0 && figures.hover_time_s.is_finite());
        prop_assert!(figures.range_m >= 0.0 && figures.range_m.is_finite());
        prop_assert!(figures.radius_m(8.0) <= figures.radius_m(0.0));
        if figures.thrust_to_weight < 1.0 {
            prop_assert!(!design.is_airworthy(air));
        }
    }
}
