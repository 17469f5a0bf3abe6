//! Several numbers together: points, areas, and pairs from low to high.

use toml::Spanned;
use toml::de::DeValue;

use super::FileValue;
use super::figure::{NumberValue, number, spaced};
use crate::mission::Point;
use crate::mission::format::POINT_RANGE;
use crate::mission::format::description::FileShape;
use crate::mission::format::draft::Draft;
use crate::text;
use crate::text::Text;

/// See [`point`], [`gate`] and [`area`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct PointsValue<const N: usize> {
    form: &'static str,
    is_good: fn([f64; N]) -> bool,
    /// Returns the fault for an invalid value of the key with this name.
    fault: fn(&str) -> Text,
}

pub(in crate::mission) const fn point() -> PointsValue<2> {
    PointsValue {
        form: "[east, north]",
        is_good: |point: Point| point.iter().all(|&axis| is_near(axis)),
        fault: |name| {
            let range = POINT_RANGE.to_string();
            text!("fault-point", name = name, range = range)
        },
    }
}

/// A point in the air.
pub(in crate::mission) const fn gate() -> PointsValue<3> {
    PointsValue {
        form: "[east, north, up]",
        is_good: |[east_m, north_m, up_m]| {
            is_near(east_m) && is_near(north_m) && (0.0..=1000.0).contains(&up_m)
        },
        fault: |_| text!("fault-gate", range = POINT_RANGE.to_string()),
    }
}

pub(in crate::mission) const fn area() -> PointsValue<4> {
    PointsValue {
        form: "[west, south, east, north]",
        is_good: |sides| sides.iter().all(|&side| is_near(side)),
        fault: |name| {
            let range = POINT_RANGE.to_string();
            text!("fault-area", name = name, range = range)
        },
    }
}

fn is_near(axis_m: f64) -> bool {
    (-POINT_RANGE..=POINT_RANGE).contains(&axis_m)
}

impl<const N: usize> FileValue for PointsValue<N>
where
    [f64; N]: for<'de> serde::Deserialize<'de>,
{
    type Out = [f64; N];

    fn shape(&self) -> FileShape {
        FileShape::Numbers {
            count: N,
            low: -POINT_RANGE,
            high: POINT_RANGE,
            unit: "m",
            form: self.form,
        }
    }

    fn read(
        &self,
        name: &str,
        written: Spanned<DeValue<'_>>,
        draft: &mut Draft,
    ) -> Option<[f64; N]> {
        let place = written.span();
        let point: [f64; N] = draft.faults.read(written)?;
        let good = (self.is_good)(point);
        if !good {
            draft.faults.add(place, (self.fault)(name));
        }
        good.then_some(point)
    }
}

/// See [`rising`] and [`spread`].
#[derive(Debug, Clone, Copy)]
pub(in crate::mission) struct PairValue {
    form: &'static str,
    bounds: NumberValue,
    may_be_equal: bool,
}

/// Two numbers within bounds, the second above the first.
pub(in crate::mission) const fn rising(form: &'static str, bounds: NumberValue) -> PairValue {
    PairValue {
        form,
        bounds,
        may_be_equal: false,
    }
}

/// Two numbers within bounds, the second not below the first.
pub(in crate::mission) const fn spread(form: &'static str, bounds: NumberValue) -> PairValue {
    PairValue {
        form,
        bounds,
        may_be_equal: true,
    }
}

/// The lowest and the highest height, in metres.
pub(in crate::mission) const fn heights() -> PairValue {
    rising("[low, high]", number(0.0, 1000.0, "m"))
}

impl FileValue for PairValue {
    type Out = [f64; 2];

    fn shape(&self) -> FileShape {
        FileShape::Numbers {
            count: 2,
            low: self.bounds.low,
            high: self.bounds.high,
            unit: self.bounds.unit,
            form: self.form,
        }
    }

    fn read(
        &self,
        name: &str,
        written: Spanned<DeValue<'_>>,
        draft: &mut Draft,
    ) -> Option<[f64; 2]> {
        let place = written.span();
        let [first, second]: [f64; 2] = draft.faults.read(written)?;
        let NumberValue { low, high, unit } = self.bounds;
        let ordered = first < second || (self.may_be_equal && first <= second);
        let good = low <= first && ordered && second <= high;
        if !good {
            let (low, high) = (low.to_string(), high.to_string());
            let unit = spaced(unit);
            draft.faults.add(
                place,
                if self.may_be_equal {
                    text!(
                        "fault-pair-equal",
                        name = name,
                        low = low,
                        high = high,
                        unit = unit
                    )
                } else {
                    text!(
                        "fault-pair",
                        name = name,
                        low = low,
                        high = high,
                        unit = unit
                    )
                },
            );
        }
        good.then_some([first, second])
    }
}
