//! The system ids in a vehicle's parameters: its own, and those of the ground stations that it obeys.
//!
//! `ArduPilot` has renamed them in 4.7.

use super::ParameterList;
use crate::wire::SystemId;

const OWN: [&str; 2] = ["SYSID_THISMAV", "MAV_SYSID"];
const STATION: [&str; 2] = ["SYSID_MYGCS", "MAV_GCS_SYSID"];
/// The end of the range of stations, if it is greater than the first one.
const LAST_STATION: &str = "MAV_GCS_SYSID_HI";

/// A station's right to hold the channels of a vehicle with `ArduPilot`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum StationRight {
    Obeyed,
    /// The parameter with this name has another station's id.
    Ignored {
        parameter: &'static str,
        station: SystemId,
    },
    /// The parameter has not been read.
    Unknown,
}

/// The id that the vehicle uses from its next start; `None` if it has not been read.
pub fn own_system(list: &ParameterList) -> Option<SystemId> {
    id_of(list, &OWN).map(|(_, id)| id)
}

/// Whether a vehicle obeys the channels that this station holds.
pub fn right_of(station: SystemId, list: &ParameterList) -> StationRight {
    let Some((parameter, first)) = id_of(list, &STATION) else {
        return StationRight::Unknown;
    };
    let last = id_of(list, &[LAST_STATION]).map_or(first, |(_, last)| last.max(first));
    if (first..=last).contains(&station) {
        StationRight::Obeyed
    } else {
        StationRight::Ignored {
            parameter,
            station: first,
        }
    }
}

fn id_of(list: &ParameterList, names: &[&'static str]) -> Option<(&'static str, SystemId)> {
    let mut found = names.iter().filter_map(|&name| {
        let value = list.get(name)?.value;
        Some((name, value as SystemId))
    });
    found.next()
}

#[cfg(test)]
mod tests {
    use super::super::{HeardParameter, ParameterEncoding, ParameterType};
    use super::*;

    fn list(values: &[(&str, f64)]) -> ParameterList {
        let mut list = ParameterList::default();
        for &(name, value) in values {
            list.note(&HeardParameter {
                name,
                value,
                kind: ParameterType::Uint8,
                encoding: ParameterEncoding::Converted,
                index: None,
                count: 9,
            });
        }
        list
    }

    #[test]
    fn a_station_is_obeyed_by_its_id_or_within_the_range() {
        let right = |station, values| right_of(station, &list(values));
        let ignored = |parameter, station| StationRight::Ignored { parameter, station };
        assert_eq!(right(255, &[]), StationRight::Unknown);
        let old = &[("SYSID_MYGCS", 255.0)];
        assert_eq!(right(255, old), StationRight::Obeyed);
        assert_eq!(right(77, old), ignored("SYSID_MYGCS", 255));
        let one = &[("MAV_GCS_SYSID", 250.0), ("MAV_GCS_SYSID_HI", 0.0)];
        assert_eq!(right(250, one), StationRight::Obeyed);
        assert_eq!(right(251, one), ignored("MAV_GCS_SYSID", 250));
        let range = &[("MAV_GCS_SYSID", 70.0), ("MAV_GCS_SYSID_HI", 80.0)];
        assert_eq!(right(77, range), StationRight::Obeyed);
    }

    #[test]
    fn both_names_of_the_own_id_count() {
        for name in ["SYSID_THISMAV", "MAV_SYSID"] {
            assert_eq!(own_system(&list(&[(name, 7.0)])), Some(7));
        }
        assert_eq!(own_system(&list(&[])), None);
    }
}
