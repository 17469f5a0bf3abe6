//! The figures of a design for display: name, value, unit, and which direction is better.

use super::air::Air;
use super::design::Design;
use super::driving::DriveFigures;
use super::figures::{Figures, Performance};
use super::kind::DesignKind;
use crate::text;
use crate::text::Text;

/// A figure of a design for display.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// The mass ready to fly, in kilograms.
    Mass,
    /// The price of all parts, in credits.
    Cost,
    /// The thrust of all motors, in newtons.
    Thrust,
    /// The thrust as a multiple of the weight.
    Ratio,
    /// The electrical power in the hover.
    HoverPower,
    /// The current from the battery in the hover.
    HoverCurrent,
    /// The hover time with the usable part of the charge.
    HoverTime,
    /// Nominal energy of the battery.
    Energy,
    /// The speed of the longest flight time.
    EnduranceSpeed,
    Longest,
    /// The speed of the longest range.
    RangeSpeed,
    Range,
    /// The fastest level flight or drive.
    TopSpeed,
    /// The reach of the radio with a fade margin of 20 dB: of a drone at a height of 50 m, of others on the ground or
    /// water.
    RadioReach,
    /// The mass that can be added.
    Spare,
    /// The pull of the wheels or the thrust of the thrusters from a standstill, in newtons.
    Pull,
    /// The resistance at cruise speed, in newtons.
    Resistance,
    CruiseSpeed,
    CruisePower,
    CruiseCurrent,
    /// The driving time at cruise speed with the usable part of the charge.
    DriveTime,
    /// The distance at cruise speed in that time.
    DriveRange,
    /// The radius of the tightest turn.
    TurningRadius,
    /// The steepest slope that it climbs, in degrees.
    Slope,
    /// The mass that the chassis or hull can still carry.
    Load,
}

/// The direction of change that improves a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Better {
    More,
    Less,
    /// Neither direction is better in general.
    Neither,
}

impl Measure {
    /// The most measures of one kind of vehicle.
    pub const MOST: usize = 15;

    /// The measures of a drone, in the order of a sheet.
    const OF_DRONE: [Self; Self::MOST] = [
        Self::Mass,
        Self::Cost,
        Self::Thrust,
        Self::Ratio,
        Self::HoverPower,
        Self::HoverCurrent,
        Self::HoverTime,
        Self::Energy,
        Self::EnduranceSpeed,
        Self::Longest,
        Self::RangeSpeed,
        Self::Range,
        Self::TopSpeed,
        Self::RadioReach,
        Self::Spare,
    ];

    /// The measures of a ground robot, in the order of a sheet; the last one is not that of a boat.
    const OF_DRIVEN: [Self; Self::MOST] = [
        Self::Mass,
        Self::Cost,
        Self::Pull,
        Self::Resistance,
        Self::TopSpeed,
        Self::CruiseSpeed,
        Self::CruisePower,
        Self::CruiseCurrent,
        Self::DriveTime,
        Self::DriveRange,
        Self::Energy,
        Self::TurningRadius,
        Self::RadioReach,
        Self::Load,
        Self::Slope,
    ];

    /// The measures of a kind of vehicle, in the order of a sheet.
    pub fn of_kind(kind: DesignKind) -> &'static [Self] {
        match kind {
            DesignKind::Drone => &Self::OF_DRONE,
            DesignKind::Robot => &Self::OF_DRIVEN,
            DesignKind::Boat => &Self::OF_DRIVEN[..Self::MOST - 1],
        }
    }

    /// The measures of two sheets side by side: those of the first one, then the others of the second.
    pub fn of_both(one: &Sheet, two: &Sheet) -> Vec<Self> {
        let mut all = one.measures().to_vec();
        let others = two
            .measures()
            .iter()
            .filter(|it| !one.measures().contains(it));
        all.extend(others);
        all
    }

    /// The measure's name on the screen.
    pub fn name(self) -> Text {
        match self {
            Self::Mass => text!("measure-mass"),
            Self::Cost => text!("measure-cost"),
            Self::Thrust => text!("measure-thrust"),
            Self::Ratio => text!("measure-ratio"),
            Self::HoverPower => text!("measure-hover-power"),
            Self::HoverCurrent => text!("measure-hover-current"),
            Self::HoverTime => text!("measure-hover-time"),
            Self::Energy => text!("measure-energy"),
            Self::EnduranceSpeed => text!("measure-endurance-speed"),
            Self::Longest => text!("measure-longest"),
            Self::RangeSpeed => text!("measure-range-speed"),
            Self::Range => text!("measure-range"),
            Self::TopSpeed => text!("measure-top-speed"),
            Self::RadioReach => text!("measure-radio"),
            Self::Spare => text!("measure-spare"),
            Self::Pull => text!("measure-pull"),
            Self::Resistance => text!("measure-resistance"),
            Self::CruiseSpeed => text!("measure-cruise-speed"),
            Self::CruisePower => text!("measure-cruise-power"),
            Self::CruiseCurrent => text!("measure-cruise-current"),
            Self::DriveTime => text!("measure-drive-time"),
            Self::DriveRange => text!("measure-drive-range"),
            Self::TurningRadius => text!("measure-turning-radius"),
            Self::Slope => text!("measure-slope"),
            Self::Load => text!("measure-load"),
        }
    }

    /// The measure's unit; empty for a ratio.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Mass | Self::Spare | Self::Load => "kg",
            Self::Cost => "cr",
            Self::Thrust | Self::Pull | Self::Resistance => "N",
            Self::Ratio => "",
            Self::HoverPower | Self::CruisePower => "W",
            Self::HoverCurrent | Self::CruiseCurrent => "A",
            Self::HoverTime | Self::Longest | Self::DriveTime => "min",
            Self::Energy => "Wh",
            Self::EnduranceSpeed | Self::RangeSpeed | Self::TopSpeed | Self::CruiseSpeed => "m/s",
            Self::Range | Self::RadioReach | Self::DriveRange => "km",
            Self::TurningRadius => "m",
            Self::Slope => "deg",
        }
    }

    /// The number of decimals to show.
    pub fn decimals(self) -> usize {
        match self {
            Self::Cost
            | Self::HoverPower
            | Self::Energy
            | Self::Thrust
            | Self::Pull
            | Self::CruisePower
            | Self::Slope => 0,
            Self::Mass | Self::Ratio | Self::Spare | Self::Load => 2,
            Self::HoverCurrent
            | Self::HoverTime
            | Self::EnduranceSpeed
            | Self::Longest
            | Self::RangeSpeed
            | Self::Range
            | Self::TopSpeed
            | Self::RadioReach
            | Self::Resistance
            | Self::CruiseSpeed
            | Self::CruiseCurrent
            | Self::DriveTime
            | Self::DriveRange
            | Self::TurningRadius => 1,
        }
    }

    /// Which direction is better.
    pub fn better(self) -> Better {
        match self {
            Self::Mass
            | Self::Cost
            | Self::HoverPower
            | Self::HoverCurrent
            | Self::Resistance
            | Self::CruisePower
            | Self::CruiseCurrent
            | Self::TurningRadius => Better::Less,
            Self::EnduranceSpeed | Self::RangeSpeed | Self::CruiseSpeed => Better::Neither,
            Self::Thrust
            | Self::Ratio
            | Self::HoverTime
            | Self::Energy
            | Self::Longest
            | Self::Range
            | Self::TopSpeed
            | Self::RadioReach
            | Self::Spare
            | Self::Pull
            | Self::DriveTime
            | Self::DriveRange
            | Self::Slope
            | Self::Load => Better::More,
        }
    }

    /// The measure's value, in its unit; `None` if the design lacks the parts for it.
    pub fn of(self, sheet: &Sheet) -> Option<f64> {
        let performance = sheet.performance.as_ref();
        let figure = |value: fn(&Figures) -> f64| performance?.flight().map(value);
        let driven = |value: fn(&DriveFigures) -> f64| performance?.drive().map(value);
        let either = |flown: fn(&Figures) -> f64, value| figure(flown).or_else(|| driven(value));
        match self {
            Self::Mass => Some(sheet.mass_kg),
            Self::Cost => Some(f64::from(sheet.credits)),
            Self::Thrust => figure(|it| it.max_thrust_n),
            Self::Ratio => figure(|it| it.thrust_to_weight),
            Self::HoverPower => figure(|it| it.hover_power_w),
            Self::HoverCurrent => figure(|it| it.hover_current_a),
            Self::HoverTime => figure(|it| it.hover_time_s / 60.0),
            Self::Energy => either(|it| it.energy_wh, |it| it.energy_wh),
            Self::EnduranceSpeed => figure(|it| it.endurance_speed_m_s),
            Self::Longest => figure(|it| it.longest_s / 60.0),
            Self::RangeSpeed => figure(|it| it.range_speed_m_s),
            Self::Range => figure(|it| it.range_m / 1000.0),
            Self::TopSpeed => either(|it| it.top_speed_m_s, |it| it.top_speed_m_s),
            Self::RadioReach => sheet.reach_m.map(|reach_m| reach_m / 1000.0),
            Self::Spare => figure(|it| it.spare_kg),
            Self::Pull => driven(|it| it.pull_n),
            Self::Resistance => driven(|it| it.resistance_n),
            Self::CruiseSpeed => driven(|it| it.cruise_speed_m_s),
            Self::CruisePower => driven(|it| it.cruise_power_w),
            Self::CruiseCurrent => driven(|it| it.cruise_current_a),
            Self::DriveTime => driven(|it| it.drive_time_s / 60.0),
            Self::DriveRange => driven(|it| it.range_m / 1000.0),
            Self::TurningRadius => driven(|it| it.turning_radius_m),
            Self::Slope => driven(|it| it.slope_deg.unwrap_or(f64::NAN)),
            Self::Load => driven(|it| it.spare_kg),
        }
        .filter(|value| value.is_finite())
    }

    /// A value without its unit.
    pub fn figure(self, value: f64) -> String {
        let decimals = self.decimals();
        format!("{value:.decimals$}")
    }

    /// A value with its unit.
    pub fn shown(self, value: f64) -> String {
        with_unit(self.figure(value), self.unit())
    }

    /// A change with its sign, without its unit; `None` if it rounds to zero.
    pub fn difference(self, before: f64, after: f64) -> Option<String> {
        let decimals = self.decimals();
        let change = format!("{:+.decimals$}", after - before);
        let is_nothing = change.chars().all(|c| !c.is_ascii_digit() || c == '0');
        (!is_nothing).then_some(change)
    }

    /// A change with its sign and unit; `None` if it rounds to zero.
    pub fn change(self, before: f64, after: f64) -> Option<String> {
        let change = self.difference(before, after)?;
        Some(with_unit(change, self.unit()))
    }

    /// Whether a change is an improvement; `None` if that depends on the purpose, or nothing changes.
    pub fn is_gain(self, before: f64, after: f64) -> Option<bool> {
        self.change(before, after)?;
        match self.better() {
            Better::More => Some(after > before),
            Better::Less => Some(after < before),
            Better::Neither => None,
        }
    }
}

/// All displayed figures of a design, computed once.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// The kind of vehicle, which decides which figures there are.
    pub kind: DesignKind,
    mass_kg: f64,
    credits: u32,
    /// The figures; `None` while parts of the drive are missing.
    pub performance: Option<Performance>,
    reach_m: Option<f64>,
}

impl Sheet {
    /// The sheet of a design in given air.
    pub fn of(design: &Design, air: Air) -> Self {
        let kind = design.kind();
        Self {
            kind,
            mass_kg: design.mass_kg(),
            credits: design.credits(),
            performance: design.performance(air),
            reach_m: design.link(kind.radio_height_m()).map(|link| link.range_m),
        }
    }

    /// The measures of the sheet, in their order.
    pub fn measures(&self) -> &'static [Measure] {
        Measure::of_kind(self.kind)
    }
}

fn with_unit(value: String, unit: &str) -> String {
    if unit.is_empty() {
        value
    } else {
        format!("{value} {unit}")
    }
}
