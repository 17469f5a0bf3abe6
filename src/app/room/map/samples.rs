//! Readings of the virtual sensors by place: a field of means over squares.

use std::collections::BTreeMap;

use crate::geo::LatLon;
use crate::geo::maths;
use crate::text::Text;

/// The initial side of the squares, in metres.
const SIDE_M: f64 = 10.0;
/// The maximum number of squares of a sensor; beyond that, squares are merged four into one.
const MOST_SQUARES: usize = 2048;

/// All readings, by the name of the sensor.
#[derive(Debug, Clone, Default)]
pub struct Samples {
    fields: BTreeMap<String, SampleField>,
}

/// The readings of one kind of sensor.
#[derive(Debug, Clone)]
pub struct SampleField {
    pub name: Text,
    pub unit: &'static str,
    origin: LatLon,
    side_m: f64,
    squares: BTreeMap<(i32, i32), Square>,
}

#[derive(Debug, Clone, Copy, Default)]
struct Square {
    sum: f64,
    count: f64,
}

impl Samples {
    /// Adds a reading at a place.
    pub fn add(&mut self, sensor: impl Into<Text>, unit: &'static str, place: LatLon, value: f64) {
        if !value.is_finite() {
            return;
        }
        let name = sensor.into();
        let sensor = name.to_string();
        if let Some(field) = self.fields.get_mut(&sensor) {
            return field.add(place, value);
        }
        let mut field = SampleField {
            name,
            unit,
            origin: place,
            side_m: SIDE_M,
            squares: BTreeMap::new(),
        };
        field.add(place, value);
        self.fields.insert(sensor, field);
    }

    /// The sensors with readings.
    pub fn fields(&self) -> impl ExactSizeIterator<Item = (&str, &SampleField)> {
        self.fields
            .iter()
            .map(|(name, field)| (name.as_str(), field))
    }
}

impl SampleField {
    fn add(&mut self, place: LatLon, value: f64) {
        let (north_m, east_m) = self.origin.offset_to(place);
        let at = |metres: f64| (metres / self.side_m).round() as i32;
        let square = self.squares.entry((at(north_m), at(east_m))).or_default();
        square.sum += value;
        square.count += 1.0;
        if self.squares.len() > MOST_SQUARES {
            self.coarsen();
        }
    }

    fn coarsen(&mut self) {
        self.side_m *= 2.0;
        for ((north, east), fine) in std::mem::take(&mut self.squares) {
            let at = (north.div_euclid(2), east.div_euclid(2));
            let square = self.squares.entry(at).or_default();
            square.sum += fine.sum;
            square.count += fine.count;
        }
        // Square (0, 0) starts half a fine square before the origin; its centre moves with it.
        self.origin = self.origin.moved(self.side_m / 4.0, self.side_m / 4.0);
    }

    /// The side of a square, in metres.
    pub fn side_m(&self) -> f64 {
        self.side_m
    }

    /// The centres of the measured squares, with the mean reading of each.
    pub fn squares(&self) -> impl Iterator<Item = (LatLon, f64)> {
        self.squares.iter().map(|(&(north, east), square)| {
            let metres = |at: i32| f64::from(at) * self.side_m;
            let middle = self.origin.moved(metres(north), metres(east));
            (middle, square.sum / square.count)
        })
    }

    /// The top of the scale: the smallest round value (1, 2 or 5 times a power of ten) that no mean exceeds; 1 if no
    /// mean is above zero.
    pub fn top(&self) -> f64 {
        let means = self
            .squares
            .values()
            .map(|square| square.sum / square.count);
        let most = means.fold(0.0, f64::max);
        if most <= 0.0 {
            return 1.0;
        }
        let decade = maths::powf(10f64, maths::log10(most).floor());
        let rounds = [1.0, 2.0, 5.0].map(|step| step * decade);
        let above = rounds.into_iter().find(|top| *top >= most);
        above.unwrap_or(decade * 10.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOME: LatLon = LatLon::new(50.45, 30.52);

    #[test]
    fn readings_in_one_square_are_averaged() {
        let mut samples = Samples::default();
        for (value, north_m) in [(2.0, 0.0), (4.0, 4.0), (9.0, 6.0)] {
            samples.add("VOC", "ppm", HOME.moved(north_m, 0.0), value);
        }
        samples.add("VOC", "ppm", HOME, f64::NAN);
        let (name, field) = samples.fields().next().expect("a field");
        assert_eq!((name, field.unit), ("VOC", "ppm"));
        let means: Vec<f64> = field.squares().map(|(_, mean)| mean).collect();
        assert_eq!(means, [3.0, 9.0]);
        assert!((field.top() - 10.0).abs() < 1e-9);
    }

    #[test]
    fn a_large_field_becomes_coarser_and_stays_in_its_place() {
        let mut samples = Samples::default();
        for north in 0..100 {
            for east in 0..100 {
                let place = HOME.moved(10.0 * f64::from(north), 10.0 * f64::from(east));
                samples.add("VOC", "ppm", place, f64::from(north));
            }
        }
        let (_, field) = samples.fields().next().expect("a field");
        assert!(field.squares().count() <= MOST_SQUARES);
        for (middle, mean) in field.squares() {
            let (north_m, _) = HOME.offset_to(middle);
            let off_m = (north_m / 10.0 - mean).abs() * 10.0;
            assert!(off_m <= field.side_m() / 2.0 + 0.01, "{off_m} m off");
        }
    }
}
