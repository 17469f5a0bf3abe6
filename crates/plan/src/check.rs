//! Finds the faults of a document, by the rules of the vehicle that will fly it.

use crate::areas::FenceError;
use crate::board::{self, Refusal, UnstorableValue};
use crate::{Document, HeightFrame, Item, ListKind, command};

mod flight;
mod place;
mod terrain;

pub use place::FAR_M;
pub(crate) use place::is_crossed;
pub use terrain::{Leg, USUAL_CLEARANCE_M, check_terrain, legs};

/// The kind of vehicle, which determines the commands that it carries out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum VehicleKind {
    /// A multicopter or a helicopter.
    #[default]
    Copter,
    /// A fixed-wing aircraft, with or without VTOL.
    Plane,
    /// A ground vehicle or a boat.
    Rover,
}

impl VehicleKind {
    /// The kind of vehicle that a `MAV_TYPE` number means; `None` for other types.
    pub const fn of_mav_type(number: u8) -> Option<Self> {
        match number {
            2..=4 | 13..=15 | 29 | 35 => Some(Self::Copter),
            1 | 16 | 19..=25 => Some(Self::Plane),
            10 | 11 => Some(Self::Rover),
            _ => None,
        }
    }

    /// Whether this kind carries out a command of a plan. An upload accepts other commands too, but
    /// the vehicle skips them in flight. Source: `start_command` of ArduPilot 4.6's vehicles.
    const fn flies(self, number: u16) -> bool {
        match number {
            // CONTINUE_AND_CHANGE_ALT, ALTITUDE_WAIT, GO_AROUND, INVERTED_FLIGHT, VTOL_TRANSITION.
            30 | 83 | 191 | 210 | 3000 => matches!(self, Self::Plane),
            // SPLINE_WAYPOINT, WINCH.
            82 | 42_600 => matches!(self, Self::Copter),
            // LOITER_TO_ALT, VTOL_TAKEOFF, VTOL_LAND, PAYLOAD_PLACE.
            22 | 31 | 84 | 85 | 94 => matches!(self, Self::Copter | Self::Plane),
            // GUIDED_ENABLE.
            92 => matches!(self, Self::Copter | Self::Rover),
            // SET_YAW_SPEED, SET_REVERSE.
            213 => matches!(self, Self::Rover),
            194 => matches!(self, Self::Plane | Self::Rover),
            // LAND.
            21 => !matches!(self, Self::Rover),
            _ => true,
        }
    }

    /// Whether this kind keeps the parameters of a command as a copter does; a plane keeps those of
    /// a waypoint differently.
    const fn keeps_as_copter(self, number: u16) -> bool {
        !matches!(self, Self::Plane) || number != command::WAYPOINT
    }

    const fn flies_above_ground(self) -> bool {
        !matches!(self, Self::Rover)
    }
}

/// The known facts about the vehicle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CheckOptions {
    /// The kind of vehicle; `None` for the kind that the file names, or else a copter.
    pub vehicle: Option<VehicleKind>,
    /// `FENCE_ALT_MAX` in metres above home, if that fence is on.
    pub ceiling_m: Option<f32>,
    /// `FENCE_RADIUS` in metres from home, if that fence is on.
    pub radius_m: Option<f32>,
    /// Whether the vehicle has terrain data for the area.
    pub has_terrain: bool,
    /// Whether the ground may be lower than home, so that a height below home need not be
    /// underground.
    pub may_slope: bool,
}

/// The severity of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The item may be intended.
    Warning,
    /// The vehicle refuses the list, or the flight cannot go as planned.
    Error,
}

/// A fault, or a possible fault.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Finding {
    /// The list that contains the fault.
    pub list: ListKind,
    /// The item, counted from 0; `None` for the list as a whole.
    pub item: Option<usize>,
    /// The kind of finding, with its figures.
    pub kind: FindingKind,
}

/// A height with its reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Height {
    /// The height in metres above `frame`.
    pub metres: f32,
    /// The level that `metres` is measured from.
    pub frame: HeightFrame,
}

/// The kinds of findings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FindingKind {
    /// The vehicle refuses the item.
    Refused {
        /// The command of the item.
        command: u16,
        /// The reason for the refusal.
        reason: Refusal,
    },
    /// The vehicle accepts the command and skips it in flight.
    Skipped {
        /// The command that is skipped.
        command: u16,
        /// The kind of vehicle that skips it.
        vehicle: VehicleKind,
    },
    /// A parameter that the vehicle would store with a different value.
    UnstorableValue(UnstorableValue),
    /// The list has more items, including home, than the vehicle stores.
    TooMany {
        /// The number of items in the list.
        count: usize,
        /// The number of items that the vehicle stores.
        most: usize,
    },
    /// A jump that leads to no item.
    JumpNowhere {
        /// The item number that the jump names.
        target: usize,
        /// The number of the last item.
        last: usize,
    },
    /// A jump to itself, or a loop of jumps without an item to fly: the vehicle ends the plan there.
    JumpRing,
    /// A jump to a tag that no item has.
    NoTag(u16),
    /// The fence is not valid.
    Fence(FenceError),
    /// The fence takes more bytes than the vehicle has for it.
    FenceTooLarge {
        /// The bytes that the fence occupies.
        bytes: usize,
        /// The bytes that the vehicle has for fences.
        most: usize,
    },
    /// The place lies outside an inclusion area or inside an exclusion area.
    BreaksFence(BrokenArea),
    /// The leg to the item crosses the border of an area, although both its ends are allowed.
    LegBreaksFence {
        /// The area, counted from 0.
        area: usize,
    },
    /// The place is farther from home than `FENCE_RADIUS`.
    BeyondRadius {
        /// The distance from home, in metres.
        distance_m: f32,
        /// The limit, in metres.
        most_m: f32,
    },
    /// The height is above `FENCE_ALT_MAX`.
    AboveCeiling {
        /// The height above home, in metres.
        height_m: f32,
        /// The limit, in metres.
        most_m: f32,
    },
    /// Home is outside an inclusion area or inside an exclusion area.
    HomeBreaksFence(BrokenArea),
    /// No takeoff before the first place: a vehicle on the ground stays there.
    NoTakeoff,
    /// The plan does not end with a landing, a return or an unlimited loiter: a copter hovers until the battery is
    /// empty.
    NoEnd,
    /// Items that are never reached, after an end or an endless jump.
    Unreached,
    /// The plan never ends: an endless jump repeats items.
    NeverEnds {
        /// The number of the first item that is repeated.
        first: usize,
        /// The number of the last repeated item, before the jump.
        last: usize,
    },
    /// A height above terrain, and the vehicle has no terrain data.
    NoTerrain,
    /// The heights of this item and of the previous one are measured from different references.
    MixedFrames {
        /// The height of the previous item.
        before: Height,
        /// The height of this item.
        here: Height,
        /// Both heights above home, if they can be converted with the height of home.
        above_home_m: Option<[f32; 2]>,
    },
    /// The item is at or below the height of home, although the vehicle should fly there.
    LowHeight {
        /// The height above home, in metres.
        height_m: f32,
        /// Whether the ground may be lower there.
        may_slope: bool,
    },
    /// The leg to the item goes into the ground, or comes too close to it.
    LowOverGround {
        /// The minimum height of the leg above the ground, in metres.
        height_m: f32,
        /// The position of that minimum, in metres from the start of the leg.
        along_m: f32,
        /// The minimum height that is allowed, in metres.
        least_m: f32,
    },
    /// The height is measured from the ground, and no terrain file covers the leg.
    NoGround,
    /// The number of legs that no terrain file covers.
    Uncovered(usize),
    /// The height of home in the file is not that of the ground there.
    HomeHeight {
        /// The height in the file, in metres above mean sea level.
        home_m: f32,
        /// The height of the ground, in metres above mean sea level.
        ground_m: f32,
    },
    /// The rally point is outside the fence, so the vehicle ignores it.
    RallyIgnored(RallyFault),
    /// The place is far from home, which often means a wrong sign or two swapped numbers.
    FarAway {
        /// The distance from home, in metres.
        distance_m: f32,
    },
}

/// A fence area that a place breaches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BrokenArea {
    /// The area, counted from 0.
    pub area: usize,
    /// Whether the area is an exclusion area.
    pub is_exclusion: bool,
}

/// Why a vehicle ignores a rally point. Source: `AP_Rally_Copter::is_valid` of ArduPilot 4.6.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RallyFault {
    /// The point lies outside an inclusion area or inside an exclusion area.
    Area(BrokenArea),
    /// The point is farther from home than `FENCE_RADIUS`.
    Radius {
        /// The distance from home, in metres.
        distance_m: f32,
        /// The limit, in metres.
        most_m: f32,
    },
    /// The point is higher than `FENCE_ALT_MAX`.
    Ceiling {
        /// The height above home, in metres.
        height_m: f32,
        /// The limit, in metres.
        most_m: f32,
    },
}

impl FindingKind {
    /// The severity of findings of this kind.
    pub const fn severity(&self) -> Severity {
        match self {
            Self::Refused { .. }
            | Self::UnstorableValue(_)
            | Self::TooMany { .. }
            | Self::JumpNowhere { .. }
            | Self::JumpRing
            | Self::NoTag(_)
            | Self::Fence(_)
            | Self::FenceTooLarge { .. }
            | Self::BreaksFence(_)
            | Self::LegBreaksFence { .. }
            | Self::BeyondRadius { .. }
            | Self::AboveCeiling { .. }
            | Self::HomeBreaksFence(_)
            | Self::NoTerrain
            | Self::LowHeight {
                may_slope: false, ..
            }
            | Self::LowOverGround { .. } => Severity::Error,
            Self::Skipped { .. }
            | Self::NoTakeoff
            | Self::NoEnd
            | Self::Unreached
            | Self::NeverEnds { .. }
            | Self::MixedFrames { .. }
            | Self::LowHeight {
                may_slope: true, ..
            }
            | Self::NoGround
            | Self::Uncovered(_)
            | Self::HomeHeight { .. }
            | Self::RallyIgnored(_)
            | Self::FarAway { .. } => Severity::Warning,
        }
    }
}

impl Finding {
    /// The severity of the finding.
    pub const fn severity(&self) -> Severity {
        self.kind.severity()
    }
}

/// All findings, in the order of the lists and their items.
pub fn check(document: &Document, options: &CheckOptions) -> Vec<Finding> {
    let named = document
        .origin
        .and_then(|origin| VehicleKind::of_mav_type(origin.vehicle));
    let vehicle = options.vehicle.or(named).unwrap_or_default();
    let mut findings = Vec::new();
    for kind in ListKind::ALL {
        check_items(document, kind, vehicle, &mut findings);
    }
    flight::check(&document.plan, vehicle, &mut findings);
    place::check(document, vehicle, options, &mut findings);
    findings.sort_by_key(|finding| (finding.list, finding.item));
    findings
}

/// The faults that concern the upload of a list: items that the vehicle would refuse, skip or store
/// with a different value.
fn check_items(
    document: &Document,
    kind: ListKind,
    vehicle: VehicleKind,
    findings: &mut Vec<Finding>,
) {
    let items = document.list(kind);
    let mut add = |item, what| {
        findings.push(Finding {
            list: kind,
            item,
            kind: what,
        });
    };
    let count = items.len() + usize::from(kind == ListKind::Plan);
    let most = board::most_items(kind);
    if count > most {
        add(None, FindingKind::TooMany { count, most });
    }
    for (index, item) in items.iter().enumerate() {
        let command = item.command;
        match board::kept(kind, item) {
            Err(reason) => add(Some(index), FindingKind::Refused { command, reason }),
            Ok(_) if kind == ListKind::Plan && !vehicle.flies(command) => {
                add(Some(index), FindingKind::Skipped { command, vehicle });
            }
            Ok(_) if kind == ListKind::Plan && vehicle.keeps_as_copter(command) => {
                for fault in board::unstorable_values(item) {
                    add(Some(index), FindingKind::UnstorableValue(fault));
                }
            }
            Ok(_) => {}
        }
    }
    if kind == ListKind::Fence {
        let bytes = board::fence_bytes(items);
        if let Err((index, error)) = crate::Fence::check(items) {
            add(Some(index), FindingKind::Fence(error));
        } else if bytes > board::FENCE_STORAGE {
            let most = board::FENCE_STORAGE;
            add(None, FindingKind::FenceTooLarge { bytes, most });
        }
    }
}

fn plan_finding(item: usize, kind: FindingKind) -> Finding {
    Finding {
        list: ListKind::Plan,
        item: Some(item),
        kind,
    }
}

fn is_jump(item: &Item) -> bool {
    matches!(item.command, command::DO_JUMP | command::DO_JUMP_TAG)
}

#[cfg(test)]
mod tests;
