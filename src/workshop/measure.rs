//! The figures of a design for display: name, value, unit, and which direction is better.

use super::design::Design;
use super::figures::{Air, Figures};
use crate::text;
use crate::text::Text;

/// The height at which the reach of the radio is stated, in metres.
const RADIO_HEIGHT_M: f64 = 50.0;

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
    /// The fastest level flight.
    TopSpeed,
    /// The reach of the radio with a fade margin of 20 dB, at a height of 50 m.
    RadioReach,
    /// The mass that can be added.
    Spare,
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
    /// All measures, in the order of a sheet.
    pub const ALL: [Self; 15] = [
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
        }
    }

    /// The measure's unit; empty for a ratio.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Mass | Self::Spare => "kg",
            Self::Cost => "cr",
            Self::Thrust => "N",
            Self::Ratio => "",
            Self::HoverPower => "W",
            Self::HoverCurrent => "A",
            Self::HoverTime | Self::Longest => "min",
            Self::Energy => "Wh",
            Self::EnduranceSpeed | Self::RangeSpeed | Self::TopSpeed => "m/s",
            Self::Range | Self::RadioReach => "km",
        }
    }

    /// The number of decimals to show.
    pub fn decimals(self) -> usize {
        match self {
            Self::Cost | Self::HoverPower | Self::Energy | Self::Thrust => 0,
            Self::Mass | Self::Ratio | Self::Spare => 2,
            Self::HoverCurrent
            | Self::HoverTime
            | Self::EnduranceSpeed
            | Self::Longest
            | Self::RangeSpeed
            | Self::Range
            | Self::TopSpeed
            | Self::RadioReach => 1,
        }
    }

    /// Which direction is better.
    pub fn better(self) -> Better {
        match self {
            Self::Mass | Self::Cost | Self::HoverPower | Self::HoverCurrent => Better::Less,
            Self::EnduranceSpeed | Self::RangeSpeed => Better::Neither,
            Self::Thrust
            | Self::Ratio
            | Self::HoverTime
            | Self::Energy
            | Self::Longest
            | Self::Range
            | Self::TopSpeed
            | Self::RadioReach
            | Self::Spare => Better::More,
        }
    }

    /// The measure's value, in its unit; `None` if the design lacks the parts for it.
    pub fn of(self, sheet: &Sheet) -> Option<f64> {
        let figure = |value: fn(&Figures) -> f64| sheet.figures.as_ref().map(value);
        match self {
            Self::Mass => Some(sheet.mass_kg),
            Self::Cost => Some(f64::from(sheet.credits)),
            Self::Thrust => figure(|it| it.max_thrust_n),
            Self::Ratio => figure(|it| it.thrust_to_weight),
            Self::HoverPower => figure(|it| it.hover_power_w),
            Self::HoverCurrent => figure(|it| it.hover_current_a),
            Self::HoverTime => figure(|it| it.hover_time_s / 60.0),
            Self::Energy => figure(|it| it.energy_wh),
            Self::EnduranceSpeed => figure(|it| it.endurance_speed_m_s),
            Self::Longest => figure(|it| it.longest_s / 60.0),
            Self::RangeSpeed => figure(|it| it.range_speed_m_s),
            Self::Range => figure(|it| it.range_m / 1000.0),
            Self::TopSpeed => figure(|it| it.top_speed_m_s),
            Self::RadioReach => sheet.reach_m.map(|reach_m| reach_m / 1000.0),
            Self::Spare => figure(|it| it.spare_kg),
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
    mass_kg: f64,
    credits: u32,
    /// The figures; `None` while parts of the drive are missing.
    pub figures: Option<Figures>,
    reach_m: Option<f64>,
}

impl Sheet {
    /// The sheet of a design in given air.
    pub fn of(design: &Design, air: Air) -> Self {
        Self {
            mass_kg: design.mass_kg(),
            credits: design.credits(),
            figures: design.figures(air),
            reach_m: design.link(RADIO_HEIGHT_M).map(|link| link.range_m),
        }
    }
}

fn with_unit(value: String, unit: &str) -> String {
    if unit.is_empty() {
        value
    } else {
        format!("{value} {unit}")
    }
}
