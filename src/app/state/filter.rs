//! The filter for vehicles: words that must all match.
//!
//! A word matches a vehicle's number (`3`, `1-4,7`), its group (`@red`), a value (`bat<30`), or the beginning of one
//! of its properties: class, mode, `armed`, `ready`, `air`, the kinds of its alerts, the words of their texts in the
//! screen's language, and `alert` for any alert. `!` before a word negates it.

use super::{Alert, FlightView};
use crate::config::Column;
use crate::text::Locale;
use crate::vehicle::{LandedState, Vehicle, VehicleId};
use crate::vehicle_id::parse_ranges;

/// A filter for vehicles.
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
    /// Parses a filter; every text is valid.
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

    /// Whether a vehicle matches.
    pub fn fits(&self, vehicle: &Vehicle, session: &FlightView, locale: &Locale) -> bool {
        self.0
            .iter()
            .all(|term| term.fits(vehicle, session, locale))
    }
}

impl FilterTerm {
    /// A term of the filter; `None` for an unfinished word (`!`, `@`), which matches everything.
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

    fn fits(&self, vehicle: &Vehicle, session: &FlightView, locale: &Locale) -> bool {
        let figure = |column: Column| column.number(vehicle, session);
        let fits = match &self.test {
            Test::Ids(ids) => ids.binary_search(&vehicle.id).is_ok(),
            Test::Group(start) => {
                let mut groups = session.groups_of(vehicle.id).into_iter();
                groups.any(|group| group.to_lowercase().starts_with(start))
            }
            Test::Below(column, limit) => figure(*column).is_some_and(|value| value < *limit),
            Test::Above(column, limit) => figure(*column).is_some_and(|value| value > *limit),
            Test::Word(start) => says(start, vehicle, session, locale),
        };
        fits != self.negated
    }
}

/// A comparison with a bound, as in `bat<30` and `alt>10`.
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

/// Whether a property of a vehicle begins with `start`, which must be in lower case.
fn says(start: &str, vehicle: &Vehicle, session: &FlightView, locale: &Locale) -> bool {
    let begins = |word: &str| word.to_lowercase().starts_with(start);
    let mode = vehicle.mode_name();
    begins(FlightView::class(vehicle))
        || mode.is_some_and(|mode| mode.split_whitespace().any(begins))
        || states(vehicle).any(begins)
        || session
            .alerts
            .of(vehicle.id)
            .any(|one| says_alert(start, &one.alert, locale))
}

/// Whether the name of an alert's kind, or a word of its text on the screen, begins with `start`.
fn says_alert(start: &str, alert: &Alert, locale: &Locale) -> bool {
    ["alert", alert.kind.name()]
        .iter()
        .any(|name| name.starts_with(start))
        || locale
            .text(&alert.text)
            .to_lowercase()
            .split_whitespace()
            .any(|word| word.starts_with(start))
}

fn states(vehicle: &Vehicle) -> impl Iterator<Item = &'static str> {
    let arming: &[&str] = match vehicle.heartbeat {
        None => &[],
        Some(_) if vehicle.armed() => &["armed"],
        Some(_) if vehicle.ready_to_arm() => &["off", "disarmed", "ready"],
        Some(_) => &["off", "disarmed"],
    };
    let landed: &[&str] = match vehicle.landed {
        LandedState::Undefined => &[],
        LandedState::OnGround => &["ground"],
        LandedState::InAir => &["air"],
        LandedState::Takeoff => &["air", "takeoff"],
        LandedState::Landing => &["air", "landing"],
    };
    arming.iter().chain(landed).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::Language;
    use crate::vehicle::Battery;

    fn session() -> FlightView {
        let mut session = FlightView::default();
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
            session
                .alerts
                .observe(&vehicle, 20.0, std::time::Duration::ZERO);
            session.insert(vehicle.into());
        }
        session.choice.groups.insert("red".to_owned(), vec![1, 7]);
        session
    }

    fn found(text: &str, session: &FlightView, locale: &Locale) -> Vec<VehicleId> {
        let filter = VehicleFilter::new(text);
        let vehicles = session.vehicles.values();
        let fitting = vehicles.filter(|vehicle| filter.fits(vehicle, session, locale));
        fitting.map(|vehicle| vehicle.id).collect()
    }

    #[test]
    fn every_word_has_to_fit() {
        let session = session();
        let locale = Locale::default();
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
            assert_eq!(&found(text, &session, &locale), expected, "{text}");
        }
    }

    #[test]
    fn alerts_are_found_by_their_kind_and_by_the_words_that_the_screen_shows() {
        let session = session();
        let ukrainian = Locale::new(Language::Ukrainian);
        for word in ["link-lost", "без", "ALERT bat>30"] {
            assert_eq!(found(word, &session, &ukrainian), [12], "{word}");
        }
        assert!(found("lost", &session, &ukrainian).is_empty());
    }
}
