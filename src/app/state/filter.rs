//! Which vehicles are meant: words that all have to fit.
//!
//! A word fits a vehicle by its number (`3`, `1-4,7`), its group (`@red`), a figure (`bat<30`), or because something
//! that is said of it begins so: what it is, mode, `armed`, `ready`, `air`, the words of its alerts, and `alert` for
//! any of them. `!` before a word turns it round.

use super::Session;
use crate::config::Column;
use crate::language::parse_ranges;
use crate::vehicle::{LandedState, Vehicle, VehicleId};

/// What a filter asks for.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct VehicleFilter(Vec<FilterTerm>);

#[derive(Debug, Clone, PartialEq)]
struct FilterTerm {
    negated: bool,
    test: Test,
}

#[derive(Debug, Clone, PartialEq)]
enum Test {
    Ids(Vec<VehicleId>),
    Group(String),
    Below(Column, f64),
    Above(Column, f64),
    Word(String),
}

impl VehicleFilter {
    /// Reads what was written; every text is a filter.
    pub fn new(text: &str) -> Self {
        Self(
            text.split_whitespace()
                .filter_map(FilterTerm::new)
                .collect(),
        )
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether a vehicle fits.
    pub fn fits(&self, vehicle: &Vehicle, session: &Session) -> bool {
        self.0.iter().all(|term| term.fits(vehicle, session))
    }
}

impl FilterTerm {
    /// A word that is still being written (`!`, `@`) asks for nothing yet.
    fn new(word: &str) -> Option<Self> {
        let (negated, word) = match word.strip_prefix('!') {
            Some(rest) => (true, rest),
            None => (false, word),
        };
        let test = if word.is_empty() || word == "@" {
            return None;
        } else if let Some(group) = word.strip_prefix('@') {
            Test::Group(group.to_lowercase())
        } else if let Some(test) = comparison(word) {
            test
        } else if let Ok(ids) = parse_ranges(word.trim_end_matches(['-', ','])) {
            Test::Ids(ids)
        } else {
            Test::Word(word.to_lowercase())
        };
        Some(Self { negated, test })
    }

    fn fits(&self, vehicle: &Vehicle, session: &Session) -> bool {
        let figure = |column: Column| column.number(vehicle, session);
        let fits = match &self.test {
            Test::Ids(ids) => ids.binary_search(&vehicle.id).is_ok(),
            Test::Group(start) => {
                let mut groups = session.groups_of(vehicle.id).into_iter();
                groups.any(|group| group.to_lowercase().starts_with(start))
            }
            Test::Below(column, limit) => figure(*column).is_some_and(|value| value < *limit),
            Test::Above(column, limit) => figure(*column).is_some_and(|value| value > *limit),
            Test::Word(start) => {
                let said = said(vehicle, session).to_lowercase();
                said.split_whitespace().any(|word| word.starts_with(start))
            }
        };
        fits != self.negated
    }
}

/// `bat<30`, `alt>10`.
fn comparison(word: &str) -> Option<Test> {
    let at = word.find(['<', '>'])?;
    let column: Column = word[..at].parse().ok()?;
    let limit: f64 = word[at + 1..].parse().ok()?;
    Some(if word[at..].starts_with('<') {
        Test::Below(column, limit)
    } else {
        Test::Above(column, limit)
    })
}

/// All that is said of a vehicle in words.
fn said(vehicle: &Vehicle, session: &Session) -> String {
    let mut said = String::from(Session::class(vehicle));
    let mut add = |word: &str| {
        said.push(' ');
        said.push_str(word);
    };
    if let Some(mode) = vehicle.mode() {
        add(&mode.to_string());
    }
    if vehicle.heartbeat.is_some() {
        add(if vehicle.armed() {
            "armed"
        } else {
            "safe disarmed"
        });
        if !vehicle.armed() && vehicle.ready_to_arm() {
            add("ready");
        }
    }
    match vehicle.landed {
        LandedState::Undefined => {}
        LandedState::OnGround => add("ground"),
        LandedState::InAir => add("air"),
        LandedState::Takeoff => add("air takeoff"),
        LandedState::Landing => add("air landing"),
    }
    for one in session.alarms.of(vehicle.id) {
        add("alert");
        add(one.alert.kind.name());
        add(&one.alert.text.to_string());
    }
    said
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vehicle::Battery;

    fn session() -> Session {
        let mut session = Session::default();
        for id in 1..=12_u8 {
            let mut vehicle = Vehicle::new(id, 1);
            vehicle.landed = if id > 6 {
                LandedState::InAir
            } else {
                LandedState::OnGround
            };
            vehicle.link.lost = id == 12;
            vehicle.batteries.push(Battery {
                id: 0,
                voltage_v: None,
                current_a: None,
                consumed_mah: None,
                consumed_wh: None,
                remaining_percent: Some(id * 5),
                at: std::time::Duration::ZERO,
            });
            session.alarms.observe(&vehicle, std::time::Duration::ZERO);
            session.insert(vehicle.into());
        }
        session.groups.insert("red".to_owned(), vec![1, 7]);
        session
    }

    #[test]
    fn every_word_has_to_fit() {
        let session = session();
        let cases: &[(&str, &[VehicleId])] = &[
            ("", &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]),
            ("1", &[1]),
            ("1-3,12", &[1, 2, 3, 12]),
            ("1-", &[1]),
            ("@red", &[1, 7]),
            ("@re air", &[7]),
            ("AIR !12", &[7, 8, 9, 10, 11]),
            ("bat<12", &[1, 2]),
            ("alert bat>30", &[12]),
            ("link-lost", &[12]),
            ("lost", &[12]),
            ("!air !@red bat>10", &[3, 4, 5, 6]),
            ("nonsense", &[]),
        ];
        for (text, expected) in cases {
            let filter = VehicleFilter::new(text);
            let found = session.vehicles.values();
            let found = found.filter(|vehicle| filter.fits(vehicle, &session));
            let found: Vec<_> = found.map(|vehicle| vehicle.id).collect();
            assert_eq!(&found, expected, "{text}");
        }
    }
}
