//! Whether an entry of a history is possible: files may have been edited by hand.

use std::fmt::Debug;
use std::ops::RangeInclusive;

use super::{CareerEntry, CareerFlight, Purchase};

/// The days since 1970 whose dates have a four-digit year.
const DAYS: RangeInclusive<i64> = 0..=1_000_000;
const TIERS: RangeInclusive<u8> = 0..=3;
const SCORES: RangeInclusive<u16> = 0..=1000;
const OUTCOMES: RangeInclusive<f64> = 0.0..=1.0;
/// The possible rewards of a mission and prices of a part, in credits.
const CREDITS: RangeInclusive<u32> = 0..=100_000;
/// The possible costs of wear and loss on a flight, in credits.
const WEAR: RangeInclusive<u32> = 0..=1_000_000;
const LONGEST_ID: usize = 64;

impl CareerEntry {
    /// Why this entry is impossible, in English; `None` if it is possible.
    pub fn fault(&self) -> Option<String> {
        match self {
            Self::Flight(flight) => flight.fault(),
            Self::Purchase(purchase) => purchase.fault(),
        }
    }
}

impl CareerFlight {
    fn fault(&self) -> Option<String> {
        let ids = std::iter::once(&self.mission).chain(&self.drill_of);
        let outcomes = self.evidence.iter().map(|evidence| evidence.outcome);
        None.or_else(|| ids.into_iter().find_map(|id| malformed("mission", id, "-")))
            .or_else(|| beyond("tier", self.tier, &TIERS))
            .or_else(|| beyond("reward", self.reward, &CREDITS))
            .or_else(|| beyond("vehicles", self.vehicles, &(1..=u8::MAX)))
            .or_else(|| beyond("day", self.day, &DAYS))
            .or_else(|| beyond("score", self.score, &SCORES))
            .or_else(|| beyond("wear", self.wear, &WEAR))
            .or_else(|| {
                outcomes
                    .into_iter()
                    .find_map(|it| beyond("outcome", it, &OUTCOMES))
            })
    }
}

impl Purchase {
    fn fault(&self) -> Option<String> {
        malformed("part", &self.part, "-_.").or_else(|| beyond("credits", self.credits, &CREDITS))
    }
}

fn beyond<T: Copy + PartialOrd + Debug>(
    name: &str,
    value: T,
    range: &RangeInclusive<T>,
) -> Option<String> {
    let (least, most) = (range.start(), range.end());
    (!range.contains(&value)).then(|| format!("`{name}` is {value:?}, not {least:?} to {most:?}"))
}

/// A fault unless `id` consists of 1 to `LONGEST_ID` lower-case letters, digits and characters of
/// `marks`.
fn malformed(name: &str, id: &str, marks: &str) -> Option<String> {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || marks.contains(c);
    let is_fine = (1..=LONGEST_ID).contains(&id.len()) && id.chars().all(plain);
    let shown = || id.chars().take(LONGEST_ID).collect::<String>();
    (!is_fine).then(|| format!("`{name}` is {:?}, which is not an id", shown()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::{CareerStanding, Evidence, MissionCourse, Reward, Skill, Stake};
    use crate::text::Text;
    use crate::workshop::parts;

    fn flight() -> CareerFlight {
        CareerFlight {
            mission: "d00-arm-and-hover".to_owned(),
            drill_of: None,
            tier: 3,
            reward: 100_000,
            vehicles: 1,
            stake: Stake::Graded,
            flown_by: None,
            day: 20_000,
            score: 1000,
            passed: true,
            medal: None,
            evidence: vec![Evidence {
                skill: Skill::K1,
                outcome: 1.0,
                basis: None,
                what: Text::verbatim("checks"),
            }],
            wear: 0,
            imported: false,
        }
    }

    fn fault(change: impl FnOnce(&mut CareerFlight)) -> String {
        let mut flight = flight();
        change(&mut flight);
        CareerEntry::Flight(flight).fault().unwrap_or_default()
    }

    #[test]
    fn what_can_happen_has_no_fault() {
        assert_eq!(CareerEntry::Flight(flight()).fault(), None);
        for part in parts() {
            let part = part.id.to_owned();
            let bought = CareerEntry::Purchase(Purchase { part, credits: 1 });
            assert_eq!(bought.fault(), None);
        }
    }

    #[test]
    fn what_cannot_have_happened_is_named() {
        let id = "x".repeat(65);
        for (name, found) in [
            ("mission", fault(|it| it.mission = "a\u{1b}[2J".to_owned())),
            ("mission", fault(|it| it.mission.clear())),
            ("mission", fault(|it| it.drill_of = Some(id))),
            ("tier", fault(|it| it.tier = 4)),
            ("reward", fault(|it| it.reward = u32::MAX)),
            ("vehicles", fault(|it| it.vehicles = 0)),
            ("day", fault(|it| it.day = 120_000_000_000_000)),
            ("day", fault(|it| it.day = -1)),
            ("score", fault(|it| it.score = 1001)),
            ("wear", fault(|it| it.wear = 1_000_001)),
            ("outcome", fault(|it| it.evidence[0].outcome = 1e300)),
            ("outcome", fault(|it| it.evidence[0].outcome = f64::NAN)),
        ] {
            assert!(
                found.starts_with(&format!("`{name}` is")),
                "{name}: {found}"
            );
            assert!(!found.chars().any(char::is_control), "{found}");
        }
        for (part, credits) in [("A b", 1), ("s_voc", 100_001)] {
            let part = part.to_owned();
            assert!(
                CareerEntry::Purchase(Purchase { part, credits })
                    .fault()
                    .is_some()
            );
        }
    }

    #[test]
    fn even_what_cannot_have_happened_ends_no_program() {
        let rich = CareerFlight {
            reward: u32::MAX,
            wear: u32::MAX,
            ..flight()
        };
        let (mut before, course) = (CareerStanding::default(), MissionCourse::new([]));
        for mission in ["one", "two", "three"] {
            let richer = CareerFlight {
                mission: mission.to_owned(),
                wear: 0,
                ..rich.clone()
            };
            before.enter(&CareerEntry::Flight(richer));
        }
        assert_eq!(before.credits(), u32::MAX);
        let mut after = before.clone();
        after.enter(&CareerEntry::Flight(rich.clone()));
        let reward = Reward::between(&before, &after, &course, &rich);
        assert_eq!(reward.credits, 0);
    }
}
