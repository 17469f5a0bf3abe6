//! The reader of plans against a scripted vehicle, over a link that loses messages.

#![expect(
    deprecated,
    reason = "older vehicles answer only to what the dialect calls superseded"
)]

use mavlink::dialects::ardupilotmega::{
    MISSION_ACK_DATA, MISSION_COUNT_DATA, MISSION_ITEM_DATA, MISSION_ITEM_INT_DATA, MavCmd,
    MavFrame, MavMissionResult, MavMissionType,
};
use proptest::prelude::*;

use super::*;
use crate::vehicle::{AutopilotVersion, FenceShape};

mod changes;

const ALL_CAPABILITIES: u64 = MISSION_FLOAT | MISSION_INT | MISSION_FENCE | MISSION_RALLY;

fn ms(milliseconds: u64) -> Duration {
    Duration::from_millis(milliseconds)
}

/// How the vehicle answers requests.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Manner {
    Modern,
    /// It supports only the older request and the older item.
    Legacy,
    Refusing,
    Mute,
}

/// A vehicle that carries lists, the link to it, and the reader at the other end.
struct Scene {
    reader: PlanReader,
    vehicle: Vehicle,
    lists: [Vec<MISSION_ITEM_INT_DATA>; 3],
    manner: Manner,
    now: Duration,
    asked: Vec<MavMessage>,
    /// Whether each message is lost, in either direction, in order; after the last entry, no
    /// message is lost.
    losses: Vec<bool>,
}

fn waypoint(seq: u16, lon_e7: i32) -> MISSION_ITEM_INT_DATA {
    MISSION_ITEM_INT_DATA {
        param4: f32::NAN,
        x: 504_500_000,
        y: lon_e7,
        z: 20.0,
        seq,
        command: MavCmd::MAV_CMD_NAV_WAYPOINT,
        target_system: 255,
        target_component: 190,
        frame: MavFrame::MAV_FRAME_GLOBAL_RELATIVE_ALT,
        ..MISSION_ITEM_INT_DATA::DEFAULT
    }
}

fn plan_of(count: u16) -> Vec<MISSION_ITEM_INT_DATA> {
    (0..count)
        .map(|seq| waypoint(seq, 305_000_000 + i32::from(seq)))
        .collect()
}

fn capabilities(bits: u64) -> AutopilotVersion {
    AutopilotVersion {
        firmware: (4, 6, 0),
        capabilities: bits,
        board: None,
        hash: [0; 8],
    }
}

fn frame(message: MavMessage) -> Frame {
    Frame {
        system: 3,
        component: 1,
        sequence: 0,
        version: mavlink::MavlinkVersion::V2,
        seal: crate::wire::Seal::Unsigned,
        wire_len: 20,
        content: Content::Message(message),
    }
}

impl Scene {
    fn new(manner: Manner, plan: u16) -> Self {
        let mut vehicle = Vehicle::new(3, 1);
        vehicle.version = Some(capabilities(ALL_CAPABILITIES));
        Self {
            reader: PlanReader::default(),
            vehicle,
            lists: [plan_of(plan), Vec::new(), Vec::new()],
            manner,
            now: Duration::ZERO,
            asked: Vec::new(),
            losses: Vec::new(),
        }
    }

    fn is_lost(&mut self) -> bool {
        self.losses.pop().unwrap_or(false)
    }

    fn pass(&mut self, time: Duration) {
        let until = self.now + time;
        while self.now < until {
            self.now += ms(50);
            let mut out = Vec::new();
            self.reader.poll(&mut self.vehicle, self.now, &mut out);
            self.deliver(out);
        }
    }

    fn hear(&mut self, message: MavMessage) {
        let mut out = Vec::new();
        let frame = frame(message);
        self.reader
            .receive(&mut self.vehicle, &frame, self.now, &mut out);
        self.deliver(out);
    }

    fn deliver(&mut self, mut out: Vec<MavMessage>) {
        while !out.is_empty() {
            let question = out.remove(0);
            self.asked.push(question.clone());
            let answer = self.answer(&question).filter(|_| !self.is_lost());
            if self.is_lost() {
                continue;
            }
            if let Some(answer) = answer {
                let frame = frame(answer);
                self.reader
                    .receive(&mut self.vehicle, &frame, self.now, &mut out);
            }
        }
    }

    fn answer(&self, question: &MavMessage) -> Option<MavMessage> {
        if self.manner == Manner::Mute {
            return None;
        }
        match question {
            MavMessage::MISSION_REQUEST_LIST(data) => Some(self.count(data.mission_type)),
            MavMessage::MISSION_REQUEST_INT(data) if self.manner == Manner::Modern => {
                let item = self.lists[data.mission_type as usize].get(usize::from(data.seq))?;
                Some(MavMessage::MISSION_ITEM_INT(MISSION_ITEM_INT_DATA {
                    mission_type: data.mission_type,
                    ..item.clone()
                }))
            }
            MavMessage::MISSION_REQUEST(data) => {
                let item = self.lists[data.mission_type as usize].get(usize::from(data.seq))?;
                Some(MavMessage::MISSION_ITEM(as_float(item)))
            }
            _ => None,
        }
    }

    fn count(&self, mission_type: MavMissionType) -> MavMessage {
        if self.manner == Manner::Refusing {
            return MavMessage::MISSION_ACK(MISSION_ACK_DATA {
                target_system: 255,
                target_component: 190,
                mavtype: MavMissionResult::MAV_MISSION_UNSUPPORTED,
                mission_type,
                ..MISSION_ACK_DATA::DEFAULT
            });
        }
        MavMessage::MISSION_COUNT(MISSION_COUNT_DATA {
            count: self.lists[mission_type as usize].len() as u16,
            target_system: 255,
            target_component: 190,
            mission_type,
            ..MISSION_COUNT_DATA::DEFAULT
        })
    }

    fn plan(&self) -> Option<&Plan> {
        self.vehicle.plans.plan.content.as_deref()
    }

    fn asked_for(&self, wanted: impl Fn(&MavMessage) -> bool) -> usize {
        self.asked.iter().filter(|asked| wanted(asked)).count()
    }

    fn announce(&mut self, total: u16, mission_id: u32) {
        self.hear(MavMessage::MISSION_CURRENT(MISSION_CURRENT_DATA {
            total,
            mission_id,
            ..MISSION_CURRENT_DATA::DEFAULT
        }));
    }
}

fn as_float(item: &MISSION_ITEM_INT_DATA) -> MISSION_ITEM_DATA {
    MISSION_ITEM_DATA {
        x: item.x as f32 * 1e-7,
        y: item.y as f32 * 1e-7,
        z: item.z,
        seq: item.seq,
        command: item.command,
        target_system: 255,
        target_component: 190,
        frame: item.frame,
        ..MISSION_ITEM_DATA::DEFAULT
    }
}

fn is_list(message: &MavMessage) -> bool {
    matches!(message, MavMessage::MISSION_REQUEST_LIST(_))
}

#[test]
fn a_vehicle_that_is_ready_gives_its_lists_once() {
    let mut scene = Scene::new(Manner::Modern, 12);
    scene.pass(ms(2900));
    assert_eq!(scene.asked.len(), 0, "too early");
    scene.pass(Duration::from_secs(60));
    assert_eq!(scene.plan().map(|plan| plan.items.len()), Some(12));
    assert_eq!(scene.vehicle.plans.fence.transfer, Transfer::Done);
    assert_eq!(scene.vehicle.plans.rally.transfer, Transfer::Done);
    // Three counts, twelve items, three acknowledgements.
    assert_eq!(scene.asked.len(), 18);
}

#[test]
fn a_list_without_an_id_is_read_again_now_and_then_and_one_with_an_id_is_not() {
    for (mission_id, rounds) in [(0, 5), (7, 1)] {
        let mut scene = Scene::new(Manner::Modern, 12);
        scene.announce(11, mission_id);
        scene.pass(Duration::from_secs(600));
        let of_the_plan = |asked: &MavMessage| {
            matches!(asked, MavMessage::MISSION_REQUEST_LIST(data)
                if data.mission_type == MavMissionType::MAV_MISSION_TYPE_MISSION)
        };
        assert_eq!(scene.asked_for(of_the_plan), rounds);
    }
}

#[test]
fn lists_that_the_vehicle_does_not_offer_are_not_asked_for() {
    let mut scene = Scene::new(Manner::Modern, 3);
    scene.vehicle.version = Some(capabilities(MISSION_FLOAT | MISSION_RALLY));
    scene.pass(Duration::from_secs(30));
    assert_eq!(scene.plan().map(|plan| plan.items.len()), Some(3));
    assert_eq!(scene.vehicle.plans.fence.transfer, Transfer::Unsupported);
    assert_eq!(scene.asked_for(is_list), 2);
}

#[test]
fn a_vehicle_that_never_says_what_it_can_do_is_asked_for_its_plan_alone() {
    let mut scene = Scene::new(Manner::Modern, 3);
    scene.vehicle.version = None;
    scene.pass(Duration::from_secs(60));
    assert_eq!(scene.plan().map(|plan| plan.items.len()), Some(3));
    assert_eq!(scene.asked_for(is_list), 1);
    scene.vehicle.version = Some(capabilities(ALL_CAPABILITIES));
    scene.pass(Duration::from_secs(60));
    assert_eq!(scene.asked_for(is_list), 3);
}

#[test]
fn a_refusal_is_remembered() {
    let mut scene = Scene::new(Manner::Refusing, 3);
    scene.pass(Duration::from_secs(3600));
    assert_eq!(scene.asked_for(is_list), 3);
    assert_eq!(scene.vehicle.plans.plan.transfer, Transfer::Unsupported);
    scene.announce(5, 0);
    scene.announce(6, 0);
    scene.pass(Duration::from_secs(60));
    assert_eq!(scene.asked_for(is_list), 3);
}

#[test]
fn a_mute_vehicle_is_asked_ever_more_seldom_and_then_left_alone() {
    let mut scene = Scene::new(Manner::Mute, 3);
    scene.pass(Duration::from_secs(3600));
    assert_eq!(scene.vehicle.plans.plan.transfer, Transfer::Failed);
    // Four rounds of six questions for each of three lists.
    assert_eq!(scene.asked.len(), 72);
    scene.pass(Duration::from_secs(3600));
    assert_eq!(scene.asked.len(), 72);
}

#[test]
fn a_vehicle_that_knows_only_the_older_items_is_understood() {
    let older = |asked: &MavMessage| matches!(asked, MavMessage::MISSION_REQUEST(_));
    let newer = |asked: &MavMessage| matches!(asked, MavMessage::MISSION_REQUEST_INT(_));
    for (version, in_vain) in [(None, 3), (Some(capabilities(MISSION_FLOAT)), 0)] {
        let mut scene = Scene::new(Manner::Legacy, 4);
        scene.vehicle.version = version;
        scene.pass(Duration::from_secs(30));
        let plan = scene.plan().expect("a plan");
        assert_eq!(plan.items.len(), 4);
        let place = plan.items[3].place().expect("a place");
        assert!(place.distance_m(crate::geo::LatLon::new(50.45, 30.5)) < 3.0);
        assert_eq!(
            (scene.asked_for(older), scene.asked_for(newer)),
            (4, in_vain)
        );
    }
}

#[test]
fn commands_newer_than_the_dialect_and_answers_to_others_are_told_apart() {
    let mut payload = Box::new([0u8; 255]);
    payload[16..20].copy_from_slice(&504_500_000i32.to_le_bytes());
    payload[28] = 2;
    payload[30..32].copy_from_slice(&60_000u16.to_le_bytes());
    payload[32] = 255;
    payload[36..38].copy_from_slice(&[0, 1]);
    let mut newer = frame(MavMessage::MISSION_COUNT(MISSION_COUNT_DATA::DEFAULT));
    newer.content = Content::Undecoded { id: 73, payload };
    let Some((ListKind::Fence, Answer::Item(seq, item))) = wire::answer(&newer, 255) else {
        panic!("an item of the fence");
    };
    assert_eq!((seq, item.command, item.y), (2, 60_000, 0));
    let others = frame(MavMessage::MISSION_COUNT(MISSION_COUNT_DATA {
        target_system: 254,
        ..MISSION_COUNT_DATA::DEFAULT
    }));
    assert_eq!(wire::answer(&others, 255), None);
}

#[test]
fn a_fence_is_read_as_its_areas() {
    let mut scene = Scene::new(Manner::Modern, 0);
    scene.lists[1] = (0..4)
        .map(|seq| MISSION_ITEM_INT_DATA {
            param1: 4.0,
            command: MavCmd::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION,
            frame: MavFrame::MAV_FRAME_GLOBAL,
            ..waypoint(seq, 305_000_000 + 1000 * i32::from(seq))
        })
        .collect();
    scene.pass(Duration::from_secs(10));
    let fence = scene.vehicle.plans.fence.content.as_deref();
    let area = &fence.expect("a fence").areas[0];
    assert!(area.inclusion);
    assert!(matches!(&area.shape, FenceShape::Polygon(corners) if corners.len() == 4));
}

proptest! {
    /// With any losses that do not last too long, every item arrives once and in order.
    #[test]
    fn a_plan_survives_losses(
        losses in proptest::collection::vec(proptest::bool::weighted(0.2), 0..200),
        count in 0u16..40,
    ) {
        let mut scene = Scene::new(Manner::Modern, count);
        scene.losses = losses;
        scene.pass(Duration::from_secs(900));
        // The plan may already be under download again, because its list has no id.
        let is_done = |scene: &Scene| scene.vehicle.plans.plan.transfer == Transfer::Done;
        for _ in 0..60 {
            if !is_done(&scene) {
                scene.pass(Duration::from_secs(1));
            }
        }
        let plan = scene.plan().expect("a plan");
        let places: Vec<i32> = plan.items.iter()
            .map(|item| item.place().expect("a place").to_e7().1)
            .collect();
        let expected: Vec<i32> = (0..count).map(|seq| 305_000_000 + i32::from(seq)).collect();
        prop_assert_eq!(places, expected);
        prop_assert!(is_done(&scene));
    }
}
