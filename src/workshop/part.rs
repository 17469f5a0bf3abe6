//! Components of a vehicle: one [`Part`] of the catalogue, and the [`PartSlot`]s.

use crate::geo::maths;
use crate::sim::Chassis as Steering;
use crate::text;
use crate::text::Text;

const INCH_M: f64 = 0.0254;

/// A slot of a vehicle for parts, in the order of building.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PartSlot {
    /// The frame of a drone, the chassis of a robot, or the hull of a boat.
    Frame,
    /// A motor for each arm, a drive for each driven wheel, or the thrusters.
    Motor,
    /// A propeller for each motor.
    Propeller,
    /// Speed controllers, one per motor.
    Esc,
    /// The battery packs: one or several of one kind, in parallel.
    Battery,
    Autopilot,
    /// Satellite navigation and compass.
    Navigation,
    /// The power module: feeds the electronics and measures the battery.
    Power,
    /// The radio link to the ground.
    Radio,
    /// Sensors, droppers, and loads.
    Payload,
}

impl PartSlot {
    pub const ALL: [Self; 10] = [
        Self::Frame,
        Self::Motor,
        Self::Propeller,
        Self::Esc,
        Self::Battery,
        Self::Autopilot,
        Self::Navigation,
        Self::Power,
        Self::Radio,
        Self::Payload,
    ];

    /// The key of the slot in a design file.
    pub fn key(self) -> &'static str {
        match self {
            Self::Frame => "frame",
            Self::Motor => "motor",
            Self::Propeller => "propeller",
            Self::Esc => "esc",
            Self::Battery => "battery",
            Self::Autopilot => "autopilot",
            Self::Navigation => "navigation",
            Self::Power => "power",
            Self::Radio => "radio",
            Self::Payload => "payload",
        }
    }

    /// The slot's name on the screen.
    pub fn name(self) -> Text {
        match self {
            Self::Frame => text!("slot-frame"),
            Self::Motor => text!("slot-motor"),
            Self::Propeller => text!("slot-propeller"),
            Self::Esc => text!("slot-esc"),
            Self::Battery => text!("slot-battery"),
            Self::Autopilot => text!("slot-autopilot"),
            Self::Navigation => text!("slot-navigation"),
            Self::Power => text!("slot-power"),
            Self::Radio => text!("slot-radio"),
            Self::Payload => text!("slot-payload"),
        }
    }

    /// The maximum number of parts in the slot.
    pub fn room(self) -> usize {
        match self {
            Self::Battery => 4,
            Self::Payload => 16,
            Self::Frame
            | Self::Motor
            | Self::Propeller
            | Self::Esc
            | Self::Autopilot
            | Self::Navigation
            | Self::Power
            | Self::Radio => 1,
        }
    }

    /// Whether a vehicle has one piece for each motor.
    pub fn is_per_motor(self) -> bool {
        matches!(self, Self::Motor | Self::Propeller | Self::Esc)
    }

    /// Whether every vehicle that has this slot needs a part in it.
    pub fn is_required(self) -> bool {
        self != Self::Payload
    }
}

/// A kind of part. Masses, prices and powers are those of one piece.
#[derive(Debug, PartialEq)]
pub struct Part {
    /// The part's id in designs and mission files.
    pub id: &'static str,
    pub mass_g: f64,
    pub credits: u32,
    /// The power that the part draws in operation, in watts, without motors.
    pub power_w: f64,
    pub(super) spec: Spec,
}

/// Properties of one kind of part.
#[derive(Debug, PartialEq)]
pub(super) enum Spec {
    Frame(Frame),
    Motor(Motor),
    Propeller(Propeller),
    Esc(Esc),
    Battery(Battery),
    Autopilot,
    Navigation,
    PowerModule(PowerModule),
    Radio(Radio),
    /// A sensor, a dropper or a light.
    Payload,
    /// A load to drop; several may be carried.
    Load,
    Chassis(Chassis),
    WheelDrive(WheelDrive),
    /// Chains that strike the ground ahead of a robot and set off mines.
    Flail,
    Hull(Hull),
    Thruster(Thruster),
}

/// The chassis of a ground robot, with its wheels.
#[derive(Debug, PartialEq)]
pub(super) struct Chassis {
    pub steering: Steering,
    /// The number of driven wheels.
    pub motors: u8,
    pub length_m: f64,
    /// The distance between the wheels of both sides.
    pub track_m: f64,
    pub wheel_radius_m: f64,
    /// The radius of the tightest turn; 0 for a vehicle that turns on the spot.
    pub turning_radius_m: f64,
    /// The resistance to rolling on short grass, as a share of the weight.
    pub rolling: f64,
    /// Drag coefficient times area.
    pub drag_area_m2: f64,
    /// The greatest mass of the whole robot.
    pub max_mass_kg: f64,
}

/// A motor with its gear and its controller, for one driven wheel. Figures are those at the wheel.
#[derive(Debug, PartialEq)]
pub(super) struct WheelDrive {
    pub kv_rpm_v: f64,
    pub resistance_ohm: f64,
    pub idle_current_a: f64,
    pub max_current_a: f64,
    /// The efficiency of gear and controller.
    pub efficiency: f64,
    pub fewest_cells: u8,
    pub most_cells: u8,
}

/// The hull of a boat.
#[derive(Debug, PartialEq)]
pub(super) struct Hull {
    /// The number of thrusters.
    pub motors: u8,
    pub length_m: f64,
    /// The radius of the tightest turn.
    pub turning_radius_m: f64,
    /// Drag coefficient times area in water, at the mass for which the hull is built.
    pub drag_area_m2: f64,
    pub built_for_kg: f64,
    /// The greatest mass of the whole boat.
    pub max_mass_kg: f64,
}

/// A thruster with its controller.
#[derive(Debug, PartialEq)]
pub(super) struct Thruster {
    pub diameter_m: f64,
    /// The share of the electrical power that momentum theory needs for the thrust.
    pub efficiency: f64,
    /// The greatest electrical power, and the voltage at which the thruster draws it.
    pub max_power_w: f64,
    pub rated_v: f64,
    pub fewest_cells: u8,
    pub most_cells: u8,
}

#[derive(Debug, PartialEq)]
pub(super) struct Frame {
    pub motors: u8,
    pub wheelbase_m: f64,
    pub largest_propeller_in: f64,
    /// Drag coefficient times area.
    pub drag_area_m2: f64,
    /// The share of the thrust lost because the arms block the air stream.
    pub download: f64,
}

#[derive(Debug, PartialEq)]
pub(super) struct Motor {
    pub kv_rpm_v: f64,
    pub resistance_ohm: f64,
    pub idle_current_a: f64,
    pub max_current_a: f64,
    pub max_power_w: f64,
    pub fewest_cells: u8,
    pub most_cells: u8,
}

#[derive(Debug, PartialEq)]
pub(super) struct Propeller {
    pub diameter_in: f64,
    pub pitch_in: f64,
    /// `C_T` of `T = C_T rho n^2 D^4`, n in turns per second.
    pub thrust: f64,
    /// `C_P` of `P = C_P rho n^3 D^5`.
    pub power: f64,
    pub max_rpm: f64,
}

#[derive(Debug, PartialEq)]
pub(super) struct Esc {
    pub max_current_a: f64,
    pub max_cells: u8,
    pub efficiency: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Chemistry {
    Polymer,
    Ion,
}

#[derive(Debug, PartialEq)]
pub(super) struct Battery {
    pub chemistry: Chemistry,
    pub cells: u8,
    pub capacity_ah: f64,
    /// The greatest continuous current, as a multiple of the capacity.
    pub c_rate: f64,
    /// The resistance of one cell in series.
    pub cell_resistance_mohm: f64,
}

#[derive(Debug, PartialEq)]
pub(super) struct PowerModule {
    pub max_cells: u8,
    pub max_current_a: f64,
}

/// The properties of a radio that determine its range.
#[derive(Debug, PartialEq)]
pub struct Radio {
    pub power_dbm: f64,
    /// The frequency, in megahertz.
    pub frequency_mhz: f64,
    /// The weakest signal that the radio can decode.
    pub sensitivity_dbm: f64,
    /// Gain of the antenna on the drone.
    pub air_dbi: f64,
    /// Gain of the antenna on the ground.
    pub ground_dbi: f64,
    /// Losses from cables, obstructions and antenna misalignment.
    pub losses_db: f64,
    /// Whether the radio always relays the signals of other radios of its kind.
    pub relays: bool,
}

impl Part {
    /// The slot that the part belongs in.
    pub fn slot(&self) -> PartSlot {
        match self.spec {
            Spec::Frame(_) | Spec::Chassis(_) | Spec::Hull(_) => PartSlot::Frame,
            Spec::Motor(_) | Spec::WheelDrive(_) | Spec::Thruster(_) => PartSlot::Motor,
            Spec::Propeller(_) => PartSlot::Propeller,
            Spec::Esc(_) => PartSlot::Esc,
            Spec::Battery(_) => PartSlot::Battery,
            Spec::Autopilot => PartSlot::Autopilot,
            Spec::Navigation => PartSlot::Navigation,
            Spec::PowerModule(_) => PartSlot::Power,
            Spec::Radio(_) => PartSlot::Radio,
            Spec::Payload | Spec::Load | Spec::Flail => PartSlot::Payload,
        }
    }

    /// Whether the part is used up in flight, so several pieces may be on board.
    pub fn is_load(&self) -> bool {
        matches!(self.spec, Spec::Load)
    }

    /// The figures that determine the range, if the part is a radio.
    pub fn radio(&self) -> Option<&Radio> {
        match &self.spec {
            Spec::Radio(radio) => Some(radio),
            _ => None,
        }
    }

    /// The part's name on the screen: made from its figures, or its own name.
    pub fn name(&self) -> Text {
        match &self.spec {
            Spec::Motor(motor) => {
                text!("part-motor", size = self.size(), kv = whole(motor.kv_rpm_v))
            }
            Spec::Propeller(_) => self.propeller_name(),
            Spec::Battery(battery) => battery.name(),
            Spec::Frame(_)
            | Spec::Esc(_)
            | Spec::Autopilot
            | Spec::Navigation
            | Spec::PowerModule(_)
            | Spec::Radio(_)
            | Spec::Payload
            | Spec::Load
            | Spec::Chassis(_)
            | Spec::WheelDrive(_)
            | Spec::Flail
            | Spec::Hull(_)
            | Spec::Thruster(_) => Text::new(self.id, Vec::new()),
        }
    }

    /// The size of a motor's stator, from its id: `m2212_920` is 22 mm wide and 12 mm high.
    fn size(&self) -> &'static str {
        let size = self.id.trim_start_matches('m');
        size.split_once('_').map_or(size, |(size, _)| size)
    }

    /// The name of a propeller, such as `10x4.5`, with the maker if one size has several.
    fn propeller_name(&self) -> Text {
        let size = self.id.trim_start_matches('p');
        if let Some(size) = size.strip_suffix("cf") {
            text!("part-propeller-carbon", size = size)
        } else if let Some(size) = size.strip_suffix('f') {
            text!("part-propeller-folding", size = size)
        } else if let Some(size) = size.strip_suffix('p') {
            text!("part-propeller-plastic", size = size)
        } else {
            text!("part-propeller", size = size)
        }
    }
}

impl Frame {
    /// The diameter of the largest propellers that turn without touching each other (with a gap of 5 %) or that the
    /// frame allows, in inches.
    pub(super) fn clearance_in(&self) -> f64 {
        let between_m =
            self.wheelbase_m * maths::sin(std::f64::consts::PI / f64::from(self.motors));
        (between_m / 1.05 / INCH_M).min(self.largest_propeller_in)
    }
}

impl Battery {
    fn name(&self) -> Text {
        let cells = u32::from(self.cells);
        let capacity = format!("{}", self.capacity_ah);
        let rate = format!("{}", self.c_rate);
        match self.chemistry {
            Chemistry::Polymer => {
                text!("part-lipo", cells = cells, capacity = capacity, rate = rate)
            }
            Chemistry::Ion => text!(
                "part-liion",
                cells = cells,
                capacity = capacity,
                rate = rate
            ),
        }
    }
}

fn whole(value: f64) -> i64 {
    value.round() as i64
}
