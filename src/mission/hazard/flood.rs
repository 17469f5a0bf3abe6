//! `flood`: water that rises around houses with people on their roofs.
//!
//! The water's height is `level + rise t`. A person without a life vest is carried off when the water reaches the roof.

use std::time::Duration;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::people::People;
use super::placing::spread;
use super::{Field, Hazard, Object, ObjectClass};
use crate::mission::Point;
use crate::mission::format::{
    FileTable, KindOf, list, number, point, spread as spread_values, whole,
};
use crate::mission::weather::Weather;
use crate::mission::zone::Shape;
use crate::text;

const MOST_HOUSES: u32 = 500;

#[derive(Debug, Clone)]
struct Flood {
    shape: Shape,
    houses: usize,
    people: usize,
    animals: usize,
    gap_m: f64,
    roofs_m: [f64; 2],
    level_m: f64,
    rise_m_s: f64,
    nodes: Vec<Point>,
}

pub(super) const KIND: KindOf<Box<dyn Hazard>> = KindOf {
    name: "flood",
    about: "rising water around houses with people on their roofs; a person is lost if the water arrives before a kit",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn Hazard>> {
    let zone = table.need_task_zone();
    let houses = table.need("houses", whole(1, MOST_HOUSES, ""), "number of houses");
    let people = table.need(
        "people",
        whole(1, MOST_HOUSES, ""),
        "number of people, each on a separate roof",
    );
    let animals = table.or(
        "animals",
        whole(0, MOST_HOUSES, ""),
        0,
        "number of animals, each on a separate roof",
    );
    let gap_m = table.need(
        "min_gap",
        number(0.0, 1000.0, "m"),
        "minimum distance between houses",
    );
    let roofs = spread_values("[low, high]", number(-20.0, 100.0, "m"));
    let roofs_m = table.need("roofs", roofs, "heights of the roofs, above `level`");
    let level_m = table.need(
        "level",
        number(-20.0, 100.0, "m"),
        "height of the water at the start",
    );
    let rise_m_min = table.need(
        "rise",
        number(0.0, 60.0, "m/min"),
        "speed at which the water rises",
    );
    let nodes_form = list(point(), 0, usize::MAX);
    let nodes = table.may("nodes", nodes_form, "places for gauges");
    let (houses, people, roofs_m, level_m) = (houses?, people?, roofs_m?, level_m?);
    if level_m >= roofs_m[0] {
        table.fault_of("roofs", text!("fault-roofs"));
    }
    if people + animals > houses {
        table.fault_of("people", text!("fault-houses"));
    }
    Some(Box::new(Flood {
        shape: zone?.shape,
        houses: houses as usize,
        people: people as usize,
        animals: animals as usize,
        gap_m: gap_m?,
        roofs_m,
        level_m,
        rise_m_s: rise_m_min? / 60.0,
        nodes: nodes.unwrap_or_default(),
    }))
}

impl Flood {
    /// The time at which the water reaches a height; `None` if it never does.
    fn reaches(&self, height_m: f64) -> Option<Duration> {
        let seconds = (height_m - self.level_m) / self.rise_m_s;
        Duration::try_from_secs_f64(seconds).ok()
    }
}

impl Hazard for Flood {
    fn release(&self, _: &Weather, mut random: ChaCha8Rng) -> Box<dyn Field> {
        let houses = spread(
            &self.shape,
            self.houses,
            self.gap_m,
            Vec::new(),
            &mut random,
        );
        let mut people = People::new(self.nodes.clone());
        for (index, at) in houses.into_iter().enumerate() {
            let [low, high] = self.roofs_m;
            let height_m = low + (high - low) * random.random::<f64>();
            let on_roof = |class| Object {
                height_m,
                ..Object::new(class, at)
            };
            if index < self.people {
                people.add(on_roof(ObjectClass::Person), self.reaches(height_m));
            } else if index < self.people + self.animals {
                people.objects.push(on_roof(ObjectClass::Animal));
            }
        }
        Box::new(people)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::super::Load;
    use super::*;

    fn flooded() -> Box<dyn Field> {
        let hazard = Flood {
            shape: Shape::Circle {
                center: [0.0, 0.0],
                radius_m: 100.0,
            },
            houses: 8,
            people: 3,
            animals: 1,
            gap_m: 20.0,
            roofs_m: [3.0, 5.0],
            level_m: 1.0,
            rise_m_s: 0.5 / 60.0,
            nodes: vec![[0.0, -150.0]],
        };
        hazard.release(&Weather::CALM, ChaCha8Rng::seed_from_u64(4))
    }

    #[test]
    fn the_water_takes_people_without_a_vest_when_it_reaches_the_roof() {
        let mut field = flooded();
        let roofs: Vec<f64> = field
            .objects()
            .iter()
            .map(|object| object.height_m)
            .collect();
        let saved = field.objects()[0].at;
        assert!(
            field
                .affect(Load::Kit, saved)
                .is_some_and(|effect| effect.good)
        );
        for second in (0..600).step_by(10) {
            field.step(Duration::from_secs(second), &Weather::CALM);
            let level_m = 1.0 + 0.5 * second as f64 / 60.0;
            for (index, object) in field.objects().iter().enumerate() {
                let safe = index == 0 || object.class == ObjectClass::Animal;
                assert_eq!(object.present, safe || level_m < roofs[index], "{second} s");
            }
        }
        let care = field.care().unwrap_or_default();
        assert_eq!((care.people, care.helped, care.lost), (3, 1, 2));
    }

    #[test]
    fn a_node_counts_once_at_its_place() {
        let mut field = flooded();
        let mut placed = |at| {
            field
                .affect(Load::Node, at)
                .is_some_and(|effect| effect.good)
        };
        assert!(!placed([0.0, -143.0]));
        assert!(placed([0.0, -145.0]));
        assert!(!placed([0.0, -145.0]));
    }
}
