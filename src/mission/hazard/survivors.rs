//! `survivors`: people in a zone, under trees or in the open, and animals that look like them from a distance.

use std::time::Duration;

use rand::RngExt;
use rand::distr::OpenClosed01;
use rand_chacha::ChaCha8Rng;

use super::people::People;
use super::placing::spread;
use super::{Field, Hazard, Object, ObjectClass};
use crate::geo::maths;
use crate::mission::format::{
    FileTable, KindOf, LONGEST_S, number, spread as spread_values, whole,
};
use crate::mission::weather::Weather;
use crate::mission::zone::Shape;

const MOST_PEOPLE: u32 = 100;

#[derive(Debug, Clone)]
struct Survivors {
    shape: Shape,
    count: usize,
    animals: usize,
    cover: [f64; 2],
    gap_m: f64,
    /// The scale of the time that people survive, in seconds; `None` without a limit.
    lasts_s: Option<f64>,
}

pub(super) const KIND: KindOf<Box<dyn Hazard>> = KindOf {
    name: "survivors",
    about: "people at random places in a zone, and animals that look like people from a distance",
    read,
};

fn read(table: &mut FileTable<'_>) -> Option<Box<dyn Hazard>> {
    let zone = table.need_task_zone();
    let count = table.need("count", whole(1, MOST_PEOPLE, ""), "number of people");
    let animals = table.or("animals", whole(0, MOST_PEOPLE, ""), 0, "number of animals");
    let cover_form = spread_values("[low, high]", number(0.0, 0.95, ""));
    let cover = table.may(
        "cover",
        cover_form,
        "least and greatest share of an object that trees hide (default none)",
    );
    let gap_m = table.need(
        "min_gap",
        number(0.0, 1000.0, "m"),
        "minimum distance between people and animals",
    );
    let lasts_s = table.may(
        "lasts",
        number(10.0, LONGEST_S, "s"),
        "survival time: the scale of a Weibull distribution with shape 2, so few die early (default no limit)",
    );
    Some(Box::new(Survivors {
        shape: zone?.shape,
        count: count? as usize,
        animals: animals as usize,
        cover: cover.unwrap_or_default(),
        gap_m: gap_m?,
        lasts_s,
    }))
}

/// A random survival time in seconds, from the Weibull distribution with shape 2: few people are
/// lost early.
fn lasting_s(scale_s: f64, random: &mut ChaCha8Rng) -> f64 {
    let share: f64 = random.sample(OpenClosed01);
    scale_s * (-maths::ln(share)).sqrt()
}

impl Hazard for Survivors {
    fn release(&self, _: &Weather, mut random: ChaCha8Rng) -> Box<dyn Field> {
        let all = self.count + self.animals;
        let places = spread(&self.shape, all, self.gap_m, Vec::new(), &mut random);
        let mut people = People::new(Vec::new());
        people.zone = Some(self.shape.clone());
        for (index, at) in places.into_iter().enumerate() {
            let [low, high] = self.cover;
            let cover = low + (high - low) * random.random::<f64>();
            let thing = |class| Object {
                cover,
                ..Object::new(class, at)
            };
            if index < self.count {
                let lasts_s = self.lasts_s.map(|scale_s| lasting_s(scale_s, &mut random));
                people.add(
                    thing(ObjectClass::Person),
                    lasts_s.map(Duration::from_secs_f64),
                );
            } else {
                people.objects.push(thing(ObjectClass::Animal));
            }
        }
        Box::new(people)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::super::{Load, LoadEffect};
    use super::*;

    fn scattered(seed: u64, lasts_s: Option<f64>) -> Box<dyn Field> {
        let hazard = Survivors {
            shape: Shape::Circle {
                center: [0.0, 0.0],
                radius_m: 100.0,
            },
            count: 4,
            animals: 2,
            cover: [0.1, 0.4],
            gap_m: 20.0,
            lasts_s,
        };
        hazard.release(&Weather::CALM, ChaCha8Rng::seed_from_u64(seed))
    }

    #[test]
    fn people_and_animals_lie_under_cover() {
        let field = scattered(1, None);
        let objects = field.objects();
        assert!(
            objects
                .iter()
                .all(|object| (0.1..=0.4).contains(&object.cover))
        );
        let animals = objects
            .iter()
            .filter(|object| object.class == ObjectClass::Animal);
        assert_eq!((objects.len(), animals.count()), (6, 2));
    }

    #[test]
    fn a_kit_helps_people_nearby_who_have_none_yet() {
        let mut field = scattered(1, None);
        let [east, north] = field.objects()[2].at;
        let good = |effect: Option<LoadEffect>| effect.is_some_and(|effect| effect.good);
        assert!(!good(field.affect(Load::Kit, [east + 8.5, north])));
        assert!(good(field.affect(Load::Kit, [east + 7.5, north])));
        assert!(
            !good(field.affect(Load::Kit, [east, north])),
            "once is enough"
        );
        assert!(field.affect(Load::Ball, [east, north]).is_none());
        assert_eq!(field.care().map(|care| care.helped), Some(1));
    }

    #[test]
    fn who_waits_too_long_is_lost_as_the_distribution_says() {
        // S(t) = exp(-(t / 600)^2): 60.7 % survive for 424 s.
        let wait = Duration::from_secs_f64(600.0 * 0.5_f64.sqrt());
        let mut lost = 0;
        for seed in 0..500 {
            let mut field = scattered(seed, Some(600.0));
            field.step(wait, &Weather::CALM);
            let care = field.care().unwrap_or_default();
            let gone = field.objects().iter().filter(|object| !object.present);
            assert_eq!(gone.count(), care.lost);
            lost += care.lost;
        }
        let share = 1.0 - lost as f64 / 2000.0;
        assert!(
            (share - maths::exp(-0.5_f64)).abs() < 4.0 * 0.011,
            "{share}"
        );
    }
}
