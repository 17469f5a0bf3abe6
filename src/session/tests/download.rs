//! The download of parameters over links with losses, duplicates and delays.

use mavlink::dialects::ardupilotmega::{MavParamType, PARAM_VALUE_DATA, TIMESYNC_DATA};
use proptest::prelude::*;
use rand::SeedableRng as _;
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::parameters::Fetching;

const STEP: Duration = Duration::from_millis(20);

/// A vehicle with many parameters behind a lossy link.
struct Far {
    scene: Scene,
    count: u16,
    coming: Vec<(Duration, MavMessage)>,
    random: ChaCha8Rng,
    loss: f64,
    /// Messages read from the scene so far.
    read: usize,
    lists: usize,
    reads: usize,
    most_at_once: usize,
    is_answering: bool,
    /// The time between two values of a list; 0 means 2300 values a second.
    pace_ms: u64,
    way: Duration,
}

impl Far {
    fn new(count: u16, loss: f64, seed: u64) -> Self {
        let mut scene = Scene::new();
        scene.session.fetch_parameters(scene.now);
        Self {
            scene,
            count,
            coming: Vec::new(),
            random: ChaCha8Rng::seed_from_u64(seed),
            loss,
            read: 0,
            lists: 0,
            reads: 0,
            most_at_once: 0,
            is_answering: true,
            pace_ms: 0,
            way: Duration::ZERO,
        }
    }

    fn is_lost(&mut self) -> bool {
        self.random.random_bool(self.loss)
    }

    fn value(&self, index: u16) -> MavMessage {
        MavMessage::PARAM_VALUE(PARAM_VALUE_DATA {
            param_value: f32::from(index),
            param_count: self.count,
            param_index: index,
            param_id: format!("P{index}").as_str().into(),
            param_type: MavParamType::MAV_PARAM_TYPE_INT16,
        })
    }

    /// Answers requests: a list in order, single values 100 ms later.
    fn answer(&mut self) {
        self.scene.collect();
        let sent: Vec<Outgoing> = self.scene.sent[self.read..].to_vec();
        self.read = self.scene.sent.len();
        let (now, mut at_once) = (self.scene.now + 2 * self.way, 0);
        for message in sent {
            match message {
                Outgoing::Message(MavMessage::PARAM_REQUEST_LIST(_)) => {
                    self.lists += 1;
                    if self.is_answering && !self.is_lost() {
                        let values = 0..self.count;
                        let pace = self.pace_ms;
                        let paced = |index: u16| {
                            let places = u64::from(index);
                            now + ms(30)
                                + ms(if pace == 0 {
                                    places * 10 / 23
                                } else {
                                    places * pace
                                })
                        };
                        let list: Vec<_> = values
                            .map(|index| (paced(index), self.value(index)))
                            .collect();
                        self.coming.extend(list);
                    }
                }
                Outgoing::Message(MavMessage::PARAM_REQUEST_READ(data)) => {
                    self.reads += 1;
                    at_once += 1;
                    if self.is_answering && !self.is_lost() {
                        let value = self.value(data.param_index as u16);
                        self.coming.push((now + ms(100), value));
                    }
                }
                Outgoing::Message(MavMessage::TIMESYNC(data)) if !self.is_lost() => {
                    let answer = TIMESYNC_DATA { tc1: 1, ..data };
                    self.coming.push((now, MavMessage::TIMESYNC(answer)));
                }
                _ => {}
            }
        }
        self.most_at_once = self.most_at_once.max(at_once);
    }

    fn step(&mut self) {
        self.answer();
        self.scene.pass(STEP);
        let now = self.scene.now;
        let due: Vec<MavMessage> = self
            .coming
            .extract_if(.., |(at, _)| *at <= now)
            .map(|(_, message)| message)
            .collect();
        for message in due {
            let times = if self.is_lost() {
                0
            } else {
                1 + usize::from(self.is_lost())
            };
            for _ in 0..times {
                self.scene.hear(message.clone());
            }
        }
        if now.as_millis().is_multiple_of(1000) && self.is_answering {
            self.scene.heartbeat(STABILIZE, false);
        }
    }

    fn pass(&mut self, time: Duration) {
        let until = self.scene.now + time;
        while self.scene.now < until {
            self.step();
        }
    }

    fn run(&mut self, at_most: Duration) {
        while self.fetching().is_under_way() && self.scene.now < at_most {
            self.step();
        }
    }

    fn fetching(&self) -> Fetching {
        self.scene.session.parameters().fetching
    }

    fn is_whole(&self) -> bool {
        let list = self.scene.session.parameters().list;
        list.len() == usize::from(self.count)
            && (0..self.count).all(|index| {
                let known = list.get(&format!("P{index}"));
                known.is_some_and(|known| known.index == Some(index))
            })
    }
}

#[test]
fn without_loss_one_request_brings_everything() {
    let mut far = Far::new(1382, 0.0, 1);
    far.run(ms(2000));
    assert_eq!(far.fetching(), Fetching::Complete);
    assert!(far.is_whole());
    assert_eq!((far.lists, far.reads), (1, 0));
}

#[test]
fn what_was_lost_is_asked_for_by_its_place_and_never_many_at_once() {
    let mut far = Far::new(1000, 0.1, 7);
    far.run(ms(60_000));
    assert!(far.is_whole());
    assert!(far.lists <= 3, "{} lists", far.lists);
    assert!((5..200).contains(&far.reads), "{} reads", far.reads);
    assert!(far.most_at_once <= 10, "{} at once", far.most_at_once);
}

/// 1382 parameters with 30 % loss and a delay of 500 ms each way.
#[test]
fn a_long_and_lossy_way_does_not_make_the_last_ones_slow() {
    for seed in 1..=5 {
        let mut far = Far::new(1382, 0.3, seed);
        far.way = ms(500);
        far.run(ms(60_000));
        assert!(far.is_whole());
        let took = far.scene.now;
        assert!(took < ms(25_000), "seed {seed}: {took:?}");
        assert!(far.most_at_once <= 10, "{} at once", far.most_at_once);
    }
}

#[test]
fn a_link_that_was_down_goes_on_where_it_was() {
    let mut far = Far::new(500, 0.0, 3);
    far.pass(ms(120));
    let before = far.scene.session.parameters().list.received();
    assert!((1..500).contains(&before), "{before}");
    far.coming.clear();
    far.is_answering = false;
    far.pass(ms(60_000));
    let asked = (far.lists, far.reads);
    assert!(asked.1 <= 40, "a link that is lost is not asked: {asked:?}");
    far.is_answering = true;
    far.scene.heartbeat(STABILIZE, false);
    far.run(ms(90_000));
    assert_eq!(far.fetching(), Fetching::Complete);
    assert!(far.is_whole());
}

#[test]
fn a_vehicle_that_never_answers_is_left_alone_after_a_while() {
    let mut far = Far::new(0, 1.0, 3);
    for _ in 0..200 {
        far.pass(ms(1000));
        far.scene.heartbeat(STABILIZE, false);
    }
    assert_eq!(far.fetching(), Fetching::Stalled);
    let lists = far.lists;
    assert!((10..30).contains(&lists), "{lists} requests");
    far.pass(ms(1000));
    assert_eq!(far.lists, lists);
    far.count = 5;
    far.loss = 0.0;
    far.scene.session.fetch_parameters(far.scene.now);
    far.run(ms(300_000));
    assert!(far.is_whole());
}

#[test]
fn another_number_of_parameters_is_read_anew() {
    let mut far = Far::new(50, 0.0, 3);
    far.run(ms(5000));
    far.count = 60;
    let message = MavMessage::PARAM_VALUE(PARAM_VALUE_DATA {
        param_count: 60,
        param_index: u16::MAX,
        param_id: "P3".into(),
        param_type: MavParamType::MAV_PARAM_TYPE_INT16,
        param_value: 3.0,
    });
    far.scene.hear(message);
    far.scene.pass(STEP);
    far.run(ms(10_000));
    assert_eq!(far.fetching(), Fetching::Complete);
    assert!(far.is_whole());
    assert_eq!(far.lists, 2);
}

#[test]
fn a_list_that_comes_again_over_a_slow_link_is_not_cut_off_while_it_brings_what_is_known() {
    // 70 values a second: a serial radio.
    let mut far = Far::new(700, 0.0, 3);
    far.pace_ms = 14;
    far.pass(ms(5000));
    far.coming.clear();
    far.run(ms(40_000));
    assert!(far.is_whole());
    assert!(far.lists <= 2, "{} lists", far.lists);
    let asked = usize::from(far.count) - far.reads;
    assert!(far.reads <= 400, "{asked} came with the list");
}

#[test]
fn after_a_reboot_nothing_is_known_until_the_list_has_come_again() {
    let attitude = |time_boot_ms| {
        MavMessage::ATTITUDE(mavlink::dialects::ardupilotmega::ATTITUDE_DATA {
            time_boot_ms,
            ..Default::default()
        })
    };
    let mut far = Far::new(50, 0.0, 3);
    far.scene.hear(attitude(60_000));
    far.run(ms(5000));
    assert!(far.is_whole());
    far.count = 40;
    far.scene.hear(attitude(400));
    let known = far.scene.session.parameters();
    assert_eq!((known.list.len(), known.reboots), (0, 1));
    assert!(known.fetching.is_under_way());
    far.run(ms(10_000));
    assert!(far.is_whole());
    assert_eq!(far.lists, 2);
}

#[test]
fn nothing_is_asked_that_nobody_wanted() {
    let mut scene = Scene::new();
    scene.pass(ms(5000));
    let asked = |sent: &&Outgoing| {
        matches!(
            sent,
            Outgoing::Message(
                MavMessage::PARAM_REQUEST_LIST(_) | MavMessage::PARAM_REQUEST_READ(_)
            )
        )
    };
    assert_eq!(scene.sent.iter().filter(asked).count(), 0);
}

#[test]
fn a_value_that_the_type_cannot_hold_is_refused_unsent() {
    let mut far = Far::new(20, 0.0, 3);
    far.run(ms(5000));
    let set = |value: f64| {
        Command::Parameter(ParameterCommand::Set {
            name: "P3".to_owned(),
            value,
        })
    };
    for (entry, value) in [(1, 40_000.0), (2, 1.5), (3, f64::NAN)] {
        far.scene.order(entry, "param", set(value));
        assert_eq!(far.scene.states(entry), [RowState::Refused], "{value}");
    }
    assert_eq!(
        far.scene.explanation(2),
        "not sent: P3 accepts only whole numbers (int16)"
    );
    far.scene.order(4, "param", set(7.0));
    assert_eq!(far.scene.states(4), [RowState::Sent]);
}

#[test]
fn a_parameter_that_a_whole_list_lacks_is_refused_unsent() {
    let mut far = Far::new(5, 0.0, 3);
    let set = |name: &str| {
        Command::Parameter(ParameterCommand::Set {
            name: name.to_owned(),
            value: 1.0,
        })
    };
    far.scene.order(1, "param", set("ANGEL_MAX"));
    assert_eq!(far.scene.states(1), [RowState::Sent], "nobody knows yet");
    far.run(ms(5000));
    far.scene.pass(ms(5000));
    for (entry, name, reason) in [(2, "PP3", "; did you mean P3?"), (3, "NOSUCHPARAM", "")] {
        far.scene.order(entry, "param", set(name));
        assert_eq!(far.scene.states(entry), [RowState::Refused], "{name}");
        let told = format!("not sent: the vehicle has no parameter {name}{reason}");
        assert_eq!(far.scene.explanation(entry), told);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn whatever_is_lost_or_doubled_the_list_becomes_whole(
        count in 1_u16..300,
        loss in 0.0..0.4,
        seed in any::<u64>(),
    ) {
        let mut far = Far::new(count, loss, seed);
        far.run(Duration::from_secs(300));
        prop_assert_eq!(far.fetching(), Fetching::Complete);
        prop_assert!(far.is_whole());
        prop_assert!(far.most_at_once <= 10);
    }
}
