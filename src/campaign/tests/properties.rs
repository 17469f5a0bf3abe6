use proptest::prelude::*;
use proptest::sample::select;

use super::*;

fn any_entry() -> impl Strategy<Value = CareerEntry> {
    let missions = select(vec!["one", "two", "three", "four", "eight", "drill"]);
    let flown = (missions, 0u16..=1000, 0i64..400, 0u32..2000, any::<bool>()).prop_map(
        |(mission, score, day, wear, graded)| {
            let stake = if graded {
                Stake::Graded
            } else {
                Stake::Practice
            };
            CareerEntry::Flight(CareerFlight {
                stake,
                wear,
                ..flight(&course(), mission, score, day)
            })
        },
    );
    let bought = (select(parts().collect::<Vec<_>>()), 0u32..3000).prop_map(|(part, credits)| {
        CareerEntry::Purchase(crate::campaign::Purchase {
            part: part.id.to_owned(),
            credits,
        })
    });
    prop_oneof![flown, bought]
}

proptest! {
    #[test]
    fn whatever_happens_credits_add_up_and_locks_hold(entries in proptest::collection::vec(any_entry(), 0..40)) {
        let course = course();
        let mut now = CareerStanding::default();
        for entry in &entries {
            let before = now.clone();
            now.enter(entry);
            if let CareerEntry::Purchase(purchase) = entry {
                let paid = before.credits() - now.credits();
                prop_assert!(paid == 0 || paid == purchase.credits);
            } else {
                prop_assert!(now.experience().0 >= before.experience().0);
                prop_assert!(now.licence() >= before.licence());
            }
            for offer in course.offers() {
                let needs = offer.drill_of.as_deref().unwrap_or(&offer.id);
                let needs = &course.offer(needs).expect("known").requires.missions;
                let holds = needs.iter().all(|id| now.has_passed(id));
                let stage = course.stage(offer, &now, 400);
                prop_assert!(holds || !matches!(stage, MissionStage::Open));
            }
            prop_assert!(now.buy("s_gas4", &course).is_err() || now.has_passed("one"));
        }
        prop_assert_eq!(CareerStanding::of(&entries), now);
    }

    #[test]
    fn a_better_outcome_never_makes_a_skill_less_likely(outcomes in proptest::collection::vec(0.0f64..=1.0, 1..12), at in 0usize..12, more in 0.0f64..1.0) {
        let chance = |outcomes: &[f64]| {
            let mut known = Knowledge::default();
            for (day, outcome) in outcomes.iter().enumerate() {
                known.observe(*outcome, 1, "one", day as i64);
            }
            known.chance(outcomes.len() as i64)
        };
        let mut better = outcomes.clone();
        let at = at % outcomes.len();
        better[at] = (better[at] + more).min(1.0);
        prop_assert!(chance(&better) + 1e-12 >= chance(&outcomes));
        prop_assert!((0.0..=1.0).contains(&chance(&outcomes)));
    }

    #[test]
    fn entries_come_back_from_json_as_they_were(entry in any_entry()) {
        let json = serde_json::to_string(&entry).expect("it is plain");
        let back: CareerEntry = serde_json::from_str(&json).expect("it was just written");
        prop_assert_eq!(back, entry);
    }
}
