//! Problems of a design, with reasons.

mod driving;

use super::air::Air;
use super::design::Design;
use super::figures::{Figures, GOOD_THRUST, LEAST_THRUST, Performance};
use super::kind::DesignKind;
use super::part::{Esc, Motor, PartSlot, Spec};
use crate::text;
use crate::text::Text;

/// The required current rating of a speed controller, as a multiple of the motor's peak current.
const ESC_ROOM: f64 = 1.2;
/// The largest share of the battery's current that a hover should draw.
const HOVER_SHARE: f64 = 0.5;

/// The subject of a finding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FindingKind {
    /// A slot that every vehicle of the kind needs is empty.
    Missing,
    /// The propellers have no room to turn.
    Propeller,
    /// The motor is not rated for the battery's voltage.
    MotorCells,
    /// The speed controller is not rated for the battery's voltage.
    EscCells,
    /// The speed controller is not rated for the motor's peak current.
    EscCurrent,
    /// The power module is not rated for the battery's voltage.
    PowerCells,
    /// The power module is not rated for the current of a hover or a drive.
    PowerCurrent,
    /// The drone is too heavy: the thrust cannot hold a position in wind.
    Thrust,
    /// The thrust leaves little margin in wind.
    Weak,
    /// The battery's voltage collapses in a hover.
    Collapse,
    /// A hover draws more current than the battery can supply.
    HoverCurrent,
    /// A hover draws more current than the battery should supply for long.
    HoverShare,
    /// The voltage sags before the battery is empty.
    Sag,
    /// Another kind of vehicle takes the part.
    Unfit,
    /// The vehicle is heavier than its chassis or hull carries.
    Overload,
    /// The drive cannot move the vehicle.
    Stuck,
    /// The drive can hardly climb.
    Slope,
    /// The battery limits the pull.
    PeakCurrent,
}

impl FindingKind {
    /// The severity of this kind.
    pub fn severity(self) -> FindingSeverity {
        match self {
            Self::Missing
            | Self::Propeller
            | Self::MotorCells
            | Self::EscCells
            | Self::PowerCells
            | Self::PowerCurrent
            | Self::Thrust
            | Self::Collapse
            | Self::HoverCurrent
            | Self::Unfit
            | Self::Overload
            | Self::Stuck => FindingSeverity::Fault,
            Self::EscCurrent
            | Self::Weak
            | Self::HoverShare
            | Self::Sag
            | Self::Slope
            | Self::PeakCurrent => FindingSeverity::Warning,
        }
    }
}

/// How serious a finding about a design is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FindingSeverity {
    /// The design can be flown with this risk.
    Warning,
    /// The design cannot be flown.
    Fault,
}

/// A problem of a design.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignFinding {
    pub kind: FindingKind,
    /// The slot in which the problem can be fixed.
    pub slot: PartSlot,
    /// The problem and its reason, as text.
    pub text: Text,
}

impl DesignFinding {
    /// The severity of the finding's kind.
    pub fn severity(&self) -> FindingSeverity {
        self.kind.severity()
    }
}

impl Design {
    /// All problems of the design, faults first. A design without faults can fly.
    pub fn findings(&self, air: Air) -> Vec<DesignFinding> {
        self.findings_with(self.performance(air).as_ref())
    }

    /// All problems of the design; `performance` must have been computed for it.
    pub fn findings_with(&self, performance: Option<&Performance>) -> Vec<DesignFinding> {
        let mut found = PackFindings::default();
        found.complete(self);
        found.turns(self);
        found.bears(self);
        match performance {
            Some(Performance::Flight(figures)) => {
                found.flies(figures);
                found.feeds(self, figures.hover_current_a);
            }
            Some(Performance::Drive(figures)) => {
                found.drives(self, figures);
                found.feeds(self, figures.cruise_current_a);
            }
            None => {}
        }
        found
            .0
            .sort_by_key(|finding| std::cmp::Reverse(finding.severity()));
        found.0
    }

    /// Whether the design can fly at all.
    pub fn is_airworthy(&self, air: Air) -> bool {
        self.findings(air)
            .iter()
            .all(|finding| finding.severity() == FindingSeverity::Warning)
    }
}

#[derive(Default)]
struct PackFindings(Vec<DesignFinding>);

impl PackFindings {
    fn add(&mut self, kind: FindingKind, slot: PartSlot, text: Text) {
        self.0.push(DesignFinding { kind, slot, text });
    }

    /// Checks that all slots of the kind have a part, and that the kind takes all parts.
    fn complete(&mut self, design: &Design) {
        let kind = design.kind();
        let required = kind.slots().iter().filter(|slot| slot.is_required());
        for &slot in required.filter(|slot| design.in_slot(**slot).is_empty()) {
            let text = text!("finding-missing", slot = kind.slot_name(slot));
            self.add(FindingKind::Missing, slot, text);
        }
        for (part, _) in design.pieces() {
            if let Some(only) = part.only_for().filter(|only| *only != kind) {
                let text = text!(
                    "finding-unfit",
                    part = part.name(),
                    only = only.name(),
                    kind = kind.name()
                );
                self.add(FindingKind::Unfit, part.slot(), text);
            }
        }
    }

    /// Checks that the propellers have room to turn.
    fn turns(&mut self, design: &Design) {
        let (Some(Spec::Frame(frame)), Some(Spec::Propeller(propeller))) = (
            design.spec(PartSlot::Frame),
            design.spec(PartSlot::Propeller),
        ) else {
            return;
        };
        let clearance = frame.clearance_in();
        // Both sizes are stated in tenths of an inch.
        if propeller.diameter_in > clearance + 0.05 {
            let text = text!(
                "finding-propeller",
                diameter = tenths(propeller.diameter_in),
                most = tenths(clearance)
            );
            self.add(FindingKind::Propeller, PartSlot::Propeller, text);
        }
    }

    /// Checks that motors, speed controllers and battery match; any two of them can be checked without the third.
    fn bears(&mut self, design: &Design) {
        let motor = match design.spec(PartSlot::Motor) {
            Some(Spec::Motor(motor)) => Some(motor),
            _ => None,
        };
        let esc = match design.spec(PartSlot::Esc) {
            Some(Spec::Esc(esc)) => Some(esc),
            _ => None,
        };
        if let (Some(motor), Some(cells)) = (motor, design.cells()) {
            self.motor_cells(motor, cells);
        }
        if let (Some(esc), Some(cells)) = (esc, design.cells()) {
            self.esc_cells(esc, cells);
        }
        if let (Some(motor), Some(esc)) = (motor, esc) {
            self.esc_current(motor, esc);
        }
        if let (Some(Spec::PowerModule(module)), Some(cells)) =
            (design.spec(PartSlot::Power), design.cells())
            && cells > module.max_cells
        {
            let text = text!(
                "finding-power-cells",
                cells = u32::from(cells),
                most = u32::from(module.max_cells)
            );
            self.add(FindingKind::PowerCells, PartSlot::Power, text);
        }
    }

    fn motor_cells(&mut self, motor: &Motor, cells: u8) {
        if !(motor.fewest_cells..=motor.most_cells).contains(&cells) {
            let text = text!(
                "finding-motor-cells",
                cells = u32::from(cells),
                fewest = u32::from(motor.fewest_cells),
                most = u32::from(motor.most_cells)
            );
            self.add(FindingKind::MotorCells, PartSlot::Battery, text);
        }
    }

    fn esc_cells(&mut self, esc: &Esc, cells: u8) {
        if cells > esc.max_cells {
            let text = text!(
                "finding-esc-cells",
                cells = u32::from(cells),
                most = u32::from(esc.max_cells)
            );
            self.add(FindingKind::EscCells, PartSlot::Esc, text);
        }
    }

    fn esc_current(&mut self, motor: &Motor, esc: &Esc) {
        if esc.max_current_a < motor.max_current_a {
            let text = text!(
                "finding-esc-current",
                current = tenths(esc.max_current_a),
                peak = tenths(motor.max_current_a),
                wanted = tenths(ESC_ROOM * motor.max_current_a)
            );
            self.add(FindingKind::EscCurrent, PartSlot::Esc, text);
        }
    }

    /// Checks that the thrust carries the drone, and the battery lasts.
    fn flies(&mut self, figures: &Figures) {
        self.thrust(figures);
        self.hover_current(figures);
        if let Some(charge) = figures.sags_at
            && figures.thrust_to_weight >= LEAST_THRUST
        {
            let text = text!(
                "finding-sag",
                charge = charge.round() as i64,
                land = charge.round() as i64 + 5
            );
            self.add(FindingKind::Sag, PartSlot::Battery, text);
        }
    }

    fn thrust(&mut self, figures: &Figures) {
        let ratio = figures.thrust_to_weight;
        let mass = format!("{:.2}", figures.mass_kg);
        if ratio < LEAST_THRUST {
            self.add(
                FindingKind::Thrust,
                PartSlot::Motor,
                text!(
                    "finding-thrust",
                    ratio = hundredths(ratio),
                    mass = mass,
                    least = LEAST_THRUST.to_string(),
                    good = GOOD_THRUST.to_string()
                ),
            );
        } else if ratio < GOOD_THRUST {
            self.add(
                FindingKind::Weak,
                PartSlot::Motor,
                text!(
                    "finding-weak",
                    ratio = hundredths(ratio),
                    good = GOOD_THRUST.to_string()
                ),
            );
        }
    }

    fn hover_current(&mut self, figures: &Figures) {
        let most_a = figures.max_current_a;
        if !figures.hover_current_a.is_finite() {
            self.add(
                FindingKind::Collapse,
                PartSlot::Battery,
                text!("finding-collapse"),
            );
        } else if figures.hover_current_a > most_a {
            let text = text!(
                "finding-current",
                current = tenths(figures.hover_current_a),
                most = tenths(most_a)
            );
            self.add(FindingKind::HoverCurrent, PartSlot::Battery, text);
        } else if figures.hover_current_a > HOVER_SHARE * most_a {
            let text = text!(
                "finding-hover-current",
                current = tenths(figures.hover_current_a),
                most = tenths(most_a)
            );
            self.add(FindingKind::HoverShare, PartSlot::Battery, text);
        }
    }

    /// Checks that the power module supports the hover or the drive.
    fn feeds(&mut self, design: &Design, current_a: f64) {
        let Some(Spec::PowerModule(module)) = design.spec(PartSlot::Power) else {
            return;
        };
        if current_a > module.max_current_a {
            let (current, most) = (tenths(current_a), tenths(module.max_current_a));
            let text = match design.kind() {
                DesignKind::Drone => {
                    text!("finding-power-current", current = current, most = most)
                }
                DesignKind::Robot | DesignKind::Boat => {
                    text!("finding-power-cruise", current = current, most = most)
                }
            };
            self.add(FindingKind::PowerCurrent, PartSlot::Power, text);
        }
    }
}

fn tenths(value: f64) -> String {
    format!("{value:.1}")
}

fn hundredths(value: f64) -> String {
    format!("{value:.2}")
}
