//! Texts for the findings about a plan.

use super::{command_name, list_words};
use crate::plan::board::{Refusal, UnstorableValue};
use crate::plan::check::{BrokenArea, Finding, FindingKind, Height, RallyFault, VehicleKind};
use crate::plan::field::{FieldUnit, field_numbered};
use crate::plan::{FenceError, HeightFrame};
use crate::text;
use crate::text::{Text, figure};

/// The text of a finding; items have the numbers that the vehicle uses.
pub fn words(finding: &Finding) -> Text {
    let what = kind_words(&finding.kind);
    match finding.item {
        Some(index) => {
            let list = list_words(finding.list);
            text!("plan-at-item", list = list, number = index + 1, what = what)
        }
        None => what,
    }
}

/// The text of a finding that several items share; `items` count from 0.
pub fn words_of_all(finding: &Finding, items: &[usize]) -> Text {
    if items.len() < 2 {
        return words(finding);
    }
    let numbers: Vec<String> = items.iter().map(|index| (index + 1).to_string()).collect();
    text!(
        "plan-at-items",
        list = list_words(finding.list),
        numbers = numbers.join(", "),
        what = kind_words(&finding.kind)
    )
}

fn kind_words(kind: &FindingKind) -> Text {
    match kind {
        FindingKind::Refused { command, reason } => refusal(*command, *reason),
        FindingKind::Skipped { command, vehicle } => text!(
            "plan-skipped",
            command = command_name(*command),
            vehicle = vehicle_words(*vehicle)
        ),
        FindingKind::UnstorableValue(fault) => unstorable(fault),
        FindingKind::TooMany { count, most } => {
            text!("plan-too-many", count = *count, most = *most)
        }
        FindingKind::JumpNowhere { target, last } => {
            text!("plan-jump-nowhere", target = *target, last = *last)
        }
        FindingKind::JumpRing => text!("plan-jump-ring"),
        FindingKind::NoTag(tag) => text!("plan-no-tag", tag = *tag),
        FindingKind::Fence(error) => fence_error(*error),
        FindingKind::FenceTooLarge { bytes, most } => {
            text!("plan-fence-large", bytes = *bytes, most = *most)
        }
        FindingKind::BreaksFence(broken) => broken_area(*broken),
        FindingKind::LegBreaksFence { area } => text!("plan-leg-breaks-fence", area = area + 1),
        FindingKind::HomeBreaksFence(broken) => home_in_broken_area(*broken),
        FindingKind::BeyondRadius { distance_m, most_m } => beyond_radius(*distance_m, *most_m),
        FindingKind::AboveCeiling { height_m, most_m } => above_ceiling(*height_m, *most_m),
        FindingKind::NoTakeoff => text!("plan-no-takeoff"),
        FindingKind::NoEnd => text!("plan-no-end"),
        FindingKind::Unreached => text!("plan-unreached"),
        FindingKind::NeverEnds { first, last } => {
            text!("plan-never-ends", first = *first, last = *last)
        }
        FindingKind::NoTerrain => text!("plan-no-terrain"),
        FindingKind::MixedFrames {
            before,
            here,
            above_home_m,
        } => mixed_frames(*before, *here, *above_home_m),
        FindingKind::LowHeight {
            height_m,
            may_slope,
        } => low_height(*height_m, *may_slope),
        FindingKind::LowOverGround {
            height_m,
            along_m,
            least_m,
        } => low_over_ground(*height_m, *along_m, *least_m),
        FindingKind::NoGround => text!("plan-no-ground"),
        FindingKind::Uncovered(count) => text!("plan-uncovered", count = *count),
        FindingKind::HomeHeight { home_m, ground_m } => text!(
            "plan-home-height",
            home = figure(*home_m, 0),
            ground = figure(*ground_m, 0)
        ),
        FindingKind::RallyIgnored(fault) => {
            text!("plan-rally-ignored", what = rally_words(*fault))
        }
        FindingKind::FarAway { distance_m } => {
            let distance = figure(f64::from(*distance_m) / 1000.0, 0);
            text!("plan-far-away", distance = distance)
        }
    }
}

fn home_in_broken_area(BrokenArea { area, is_exclusion }: BrokenArea) -> Text {
    let area = area + 1;
    if is_exclusion {
        text!("plan-home-inside-exclusion", area = area)
    } else {
        text!("plan-home-breaks-fence", area = area)
    }
}

fn broken_area(BrokenArea { area, is_exclusion }: BrokenArea) -> Text {
    let area = area + 1;
    if is_exclusion {
        text!("plan-inside-exclusion", area = area)
    } else {
        text!("plan-breaks-fence", area = area)
    }
}

fn rally_words(fault: RallyFault) -> Text {
    match fault {
        RallyFault::Area(broken) => broken_area(broken),
        RallyFault::Radius { distance_m, most_m } => beyond_radius(distance_m, most_m),
        RallyFault::Ceiling { height_m, most_m } => above_ceiling(height_m, most_m),
    }
}

fn beyond_radius(distance_m: f32, most_m: f32) -> Text {
    let (distance, most) = (figure(distance_m, 0), figure(most_m, 0));
    text!("plan-beyond-radius", distance = distance, most = most)
}

fn above_ceiling(height_m: f32, most_m: f32) -> Text {
    let (height, most) = (figure(height_m, 0), figure(most_m, 0));
    text!("plan-above-ceiling", height = height, most = most)
}

fn low_height(height_m: f32, may_slope: bool) -> Text {
    let height = figure(height_m, 0);
    if may_slope {
        text!("plan-low-slope", height = height)
    } else {
        text!("plan-low-height", height = height)
    }
}

fn low_over_ground(height_m: f32, along_m: f32, least_m: f32) -> Text {
    let along = figure(along_m, 0);
    if height_m < 0.0 {
        let depth = figure(-height_m, 0);
        text!("plan-below-ground", depth = depth, along = along)
    } else {
        text!(
            "plan-low-over-ground",
            height = figure(height_m, 0),
            along = along,
            least = figure(least_m, 0)
        )
    }
}

fn refusal(command: u16, reason: Refusal) -> Text {
    let command = command_name(command);
    match reason {
        Refusal::Invalid | Refusal::Command => text!("plan-refused-command", command = command),
        Refusal::Frame => text!("plan-refused-frame", command = command),
        Refusal::Parameter(5) => text!("plan-refused-latitude", command = command),
        Refusal::Parameter(6) => text!("plan-refused-longitude", command = command),
        Refusal::Parameter(7) => text!("plan-refused-height", command = command),
        Refusal::Parameter(number) => {
            text!("plan-refused-parameter", command = command, number = number)
        }
    }
}

fn unstorable(fault: &UnstorableValue) -> Text {
    let field = field_numbered(fault.command, fault.parameter);
    let name = match field {
        Some(field) => field.name.to_owned(),
        None => format!("p{}", fault.parameter),
    };
    let unit = field.map_or(FieldUnit::None, |field| field.unit);
    text!(
        "plan-unstorable",
        command = command_name(fault.command),
        name = name,
        written = measured(fault.written, unit),
        stored = measured(fault.stored, unit)
    )
}

/// A value with all its digits, and its unit.
fn measured(value: f32, unit: FieldUnit) -> String {
    match unit {
        FieldUnit::None => value.to_string(),
        FieldUnit::Degrees | FieldUnit::DegreesPerSecond => format!("{value}{}", unit.symbol()),
        FieldUnit::Metres
        | FieldUnit::MetresPerSecond
        | FieldUnit::Seconds
        | FieldUnit::Microseconds
        | FieldUnit::Percent => format!("{value} {}", unit.symbol()),
    }
}

fn fence_error(error: FenceError) -> Text {
    match error {
        FenceError::VertexCount(count) => text!("plan-fence-count", count = count),
        FenceError::OtherCount { wanted, got } => {
            text!("plan-fence-other-count", wanted = wanted, got = got)
        }
        FenceError::OtherVertex { .. } | FenceError::OtherType { .. } => {
            text!("plan-fence-other-type")
        }
        FenceError::ItemCount => text!("plan-fence-missing"),
        FenceError::Radius => text!("plan-fence-radius"),
        FenceError::ReturnPoints => text!("plan-fence-returns"),
        FenceError::Place => text!("plan-fence-place"),
    }
}

fn vehicle_words(kind: VehicleKind) -> Text {
    match kind {
        VehicleKind::Copter => text!("plan-vehicle-copter"),
        VehicleKind::Plane => text!("plan-vehicle-plane"),
        VehicleKind::Rover => text!("plan-vehicle-rover"),
    }
}

fn mixed_frames(before: Height, here: Height, above_home_m: Option<[f32; 2]>) -> Text {
    let (earlier, now) = (height(before), height(here));
    match above_home_m {
        Some([first, second]) => text!(
            "plan-mixed-frames-home",
            before = earlier,
            here = now,
            first = figure(first, 0),
            second = figure(second, 0)
        ),
        None => text!("plan-mixed-frames", before = earlier, here = now),
    }
}

fn height(height: Height) -> Text {
    let metres = figure(height.metres, 0);
    match height.frame {
        HeightFrame::SeaLevel => text!("plan-height-sea", height = metres),
        HeightFrame::Home => text!("plan-height-home", height = metres),
        HeightFrame::Terrain => text!("plan-height-terrain", height = metres),
        HeightFrame::Other => text!("plan-height-other", height = metres),
    }
}
