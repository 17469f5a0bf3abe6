//! The kinds of things that names in a mission file refer to.

use crate::text;
use crate::text::Text;

/// The kind of thing that a name refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::mission) enum NameKind {
    CrewRole,
    EarlierSurvey,
    Event,
    Fault,
    FleetSensor,
    Hazard,
    HazardKind,
    Mover,
    Objective,
    ObjectiveKind,
    Part,
    Place,
    Quantity,
    Radio,
    Sensor,
    Skill,
    TaskZone,
    Threat,
    VehicleKind,
    Zone,
    ZoneKind,
}

impl NameKind {
    /// The word of the reference, which is English.
    pub fn word(self) -> &'static str {
        match self {
            Self::CrewRole => "role",
            Self::EarlierSurvey => "earlier sample_cells objective",
            Self::Event => "event",
            Self::Fault => "fault",
            Self::FleetSensor => "sensor of the fleet",
            Self::Hazard => "hazard",
            Self::HazardKind => "hazard kind",
            Self::Mover => "mover",
            Self::Objective => "objective",
            Self::ObjectiveKind => "objective kind",
            Self::Part => "part",
            Self::Place => "place",
            Self::Quantity => "quantity",
            Self::Radio => "radio",
            Self::Sensor => "sensor",
            Self::Skill => "skill",
            Self::TaskZone => "task zone",
            Self::Threat => "threat",
            Self::VehicleKind => "kind of vehicle",
            Self::Zone => "zone",
            Self::ZoneKind => "zone kind",
        }
    }

    /// The word in the user's language, for faults.
    pub fn text(self) -> Text {
        match self {
            Self::CrewRole => text!("name-crew-role"),
            Self::EarlierSurvey => text!("name-earlier-survey"),
            Self::Event => text!("name-event"),
            Self::Fault => text!("name-fault"),
            Self::FleetSensor => text!("name-fleet-sensor"),
            Self::Hazard => text!("name-hazard"),
            Self::HazardKind => text!("name-hazard-kind"),
            Self::Mover => text!("name-mover"),
            Self::Objective => text!("name-objective"),
            Self::ObjectiveKind => text!("name-objective-kind"),
            Self::Part => text!("name-part"),
            Self::Place => text!("name-place"),
            Self::Quantity => text!("name-quantity"),
            Self::Radio => text!("name-radio"),
            Self::Sensor => text!("name-sensor"),
            Self::Skill => text!("name-skill"),
            Self::TaskZone => text!("name-task-zone"),
            Self::Threat => text!("name-threat"),
            Self::VehicleKind => text!("name-vehicle-kind"),
            Self::Zone => text!("name-zone"),
            Self::ZoneKind => text!("name-zone-kind"),
        }
    }
}
