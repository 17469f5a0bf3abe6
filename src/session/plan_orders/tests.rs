//! Transfers to the embedded simulator in lock step: over a bad link, by files and by items.

use std::collections::BTreeMap;
use std::sync::Mutex;

use mavlink::dialects::ardupilotmega::{HEARTBEAT_DATA, MavMessage, PARAM_SET_DATA};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::geo::LatLon;
use crate::language;
use crate::ledger::EntryId;
use crate::notice::Notice;
use crate::session::{RadioFault, Report, Session, Want};
use crate::sim::{PortId, Start, World, WorldConfig};
use crate::wire::{Decoder, Encoder, Outgoing};

mod broken;
mod flying;

const STEP: Duration = Duration::from_millis(10);
const HOME: LatLon = LatLon {
    lat_deg: 50.4501,
    lon_deg: 30.5234,
};

fn s(seconds: u64) -> Duration {
    Duration::from_secs(seconds)
}

/// Files in memory.
#[derive(Debug, Default)]
struct Shelf(Mutex<BTreeMap<String, Document>>);

impl PlanShelf for Shelf {
    fn read(&self, file: &str) -> Result<Document, Text> {
        let files = self.0.lock().expect("no panic");
        files
            .get(file)
            .cloned()
            .ok_or_else(|| Text::verbatim("no such file"))
    }

    fn write(&self, file: &str, _: ListKind, document: &Document) -> Result<String, Text> {
        let mut files = self.0.lock().expect("no panic");
        files.insert(file.to_owned(), document.clone());
        Ok(file.to_owned())
    }

    fn keep(&self, vehicle: VehicleId, kind: ListKind, document: &Document) -> bool {
        let mut files = self.0.lock().expect("no panic");
        let name = kept_name(vehicle, kind);
        let is_new = !files.contains_key(&name);
        files.entry(name).or_insert_with(|| document.clone());
        is_new
    }

    fn release(&self, vehicle: VehicleId, kind: ListKind) {
        let mut files = self.0.lock().expect("no panic");
        files.remove(&kept_name(vehicle, kind));
    }

    fn kept(&self, vehicle: VehicleId) -> Vec<(ListKind, String)> {
        let files = self.0.lock().expect("no panic");
        let named = ListKind::ALL.map(|kind| (kind, kept_name(vehicle, kind)));
        let kept = named
            .into_iter()
            .filter(|(_, name)| files.contains_key(name));
        kept.collect()
    }
}

fn kept_name(vehicle: VehicleId, kind: ListKind) -> String {
    format!("kept {vehicle} {kind:?}")
}

/// A list of so many items, some metres apart.
fn list(kind: ListKind, count: usize, seed: f64) -> Vec<Item> {
    let item = |at: usize| {
        let place = HOME.moved(
            40.0 + 7.0 * at as f64 * seed,
            60.0 * crate::geo::maths::cos(at as f64 + seed),
        );
        let (x, y) = place.to_e7();
        let (command, params) = match kind {
            ListKind::Plan if at == 0 => (22, [0.0, 0.0, 0.0, f32::NAN]),
            ListKind::Plan if at % 5 == 3 => (178, [1.0, 4.0 + at as f32, -1.0, 0.0]),
            ListKind::Plan => (16, [3.9, 2.0, 0.0, f32::NAN]),
            ListKind::Fence => (5004, [30.0 + at as f32, 0.0, 0.0, 0.0]),
            ListKind::Rally => (5100, [0.0; 4]),
        };
        Item {
            command,
            frame: if kind == ListKind::Fence { 0 } else { 6 },
            auto_continue: true,
            params,
            x,
            y,
            z: 20.257 + at as f32,
        }
    };
    (0..count).map(item).collect()
}

/// A session, and a simulated vehicle at its other end.
struct Rig {
    world: World,
    port: PortId,
    decoder: Decoder,
    encoder: Encoder,
    session: Session,
    shelf: Arc<Shelf>,
    now: Duration,
    entries: u32,
    row: Option<RowUpdate>,
    /// The highest progress of the order.
    percent: u8,
    notices: Vec<Notice>,
}

impl Rig {
    /// A vehicle that is ready, and a session that has read its lists.
    fn new(by_file: bool) -> Self {
        let start = Start {
            at: HOME,
            altitude_amsl_m: 170.0,
            heading_deg: 0.0,
        };
        let mut world = World::new(&WorldConfig::row(1, start));
        let port = world.connect(0);
        let shelf = Arc::new(Shelf::default());
        let mut rig = Self {
            world,
            port,
            decoder: Decoder::new(),
            encoder: Encoder::new(255, 190),
            session: Session::new(1, 1, Duration::ZERO)
                .with_plan_files(Arc::clone(&shelf) as Arc<dyn PlanShelf>),
            shelf,
            now: Duration::ZERO,
            entries: 0,
            row: None,
            percent: 0,
            notices: Vec::new(),
        };
        rig.pass(s(4));
        if !by_file {
            rig.refuse_files();
        }
        rig.pass(s(20));
        assert!(known(rig.session.vehicle(), ListKind::Rally).is_some());
        assert_eq!(hands_out(&rig), by_file);
        rig
    }

    /// Sets `BRD_OPTIONS` so that the vehicle neither offers nor answers MAVFTP, and asks it anew what it offers.
    fn refuse_files(&mut self) {
        let set = MavMessage::PARAM_SET(PARAM_SET_DATA {
            param_value: 2.0,
            target_system: 1,
            target_component: 1,
            param_id: "BRD_OPTIONS".into(),
            ..PARAM_SET_DATA::DEFAULT
        });
        self.say(&set.into());
        self.pass(s(1));
        let start = self.now;
        self.session = Session::new(1, 1, start)
            .with_plan_files(Arc::clone(&self.shelf) as Arc<dyn PlanShelf>);
    }

    fn say(&mut self, message: &Outgoing) {
        let mut bytes = Vec::new();
        self.encoder.encode(message, &mut bytes);
        self.world.receive(self.port, &bytes);
    }

    fn step(&mut self) {
        self.now += STEP;
        if self.now.as_millis().is_multiple_of(1000) && !self.session.is_cut() {
            self.say(&MavMessage::HEARTBEAT(HEARTBEAT_DATA::DEFAULT).into());
        }
        for message in self.session.take_outgoing() {
            self.say(&message);
        }
        self.world.step();
        let mut bytes = Vec::new();
        self.world.take_output(self.port, &mut bytes);
        self.decoder.push(&bytes);
        while let Some(frame) = self.decoder.next_frame() {
            self.session.receive(&frame, self.now);
        }
        self.session.poll(self.now);
        for report in self.session.take_reports() {
            match report {
                Report::Row(row) => {
                    if let RowState::InProgress(percent) = row.state {
                        self.percent = self.percent.max(percent);
                    }
                    self.row = Some(row);
                }
                Report::Notice(notice) => self.notices.push(notice),
            }
        }
    }

    fn pass(&mut self, time: Duration) {
        let until = self.now + time;
        while self.now < until {
            self.step();
        }
    }

    fn radio(&mut self, loss: f64, delay_ms: u64, seed: u64) {
        self.session.carry_out(Want::Radio(RadioFault {
            loss,
            delay: Duration::from_millis(delay_ms),
            seed,
        }));
    }

    fn file(&self, name: &str, kind: ListKind, items: &[Item]) {
        let mut document = Document::default();
        *document.list_mut(kind) = items.to_vec();
        let mut files = self.shelf.0.lock().expect("no panic");
        files.insert(name.to_owned(), document);
    }

    fn order(&mut self, kind: ListKind, deed: PlanDeed) {
        self.entries += 1;
        self.row = None;
        self.percent = 0;
        let verb = language::verb("plan").expect("a verb");
        let command = Command::Plan(PlanCommand { kind, deed });
        let order = VehicleCommand::new(EntryId(self.entries), verb, command);
        self.session.order(order, self.now);
    }

    fn upload(&mut self, kind: ListKind, file: &str) {
        let file = file.to_owned();
        let source = PlanSource::File(file);
        self.order(kind, PlanDeed::Upload { source });
    }

    fn state(&self) -> Option<RowState> {
        self.row.as_ref().map(|row| row.state)
    }

    fn explanation(&self) -> String {
        let row = self.row.as_ref().expect("a row");
        row.explanation
            .as_ref()
            .map(Text::to_string)
            .unwrap_or_default()
    }

    /// Waits for the end of the order.
    fn ended(&mut self, within: Duration) -> RowState {
        let until = self.now + within;
        while !self.state().is_some_and(RowState::is_final) {
            assert!(self.now < until, "no end: {:?}", self.row);
            self.step();
        }
        self.state().expect("a row")
    }

    /// The vehicle's lists, as another program reads them over a good link.
    fn on_board(&mut self, kind: ListKind) -> Vec<Item> {
        let mut other = Session::new(1, 1, self.now);
        let port = self.world.connect(0);
        let (mut decoder, mut encoder) = (Decoder::new(), Encoder::new(255, 191));
        for _ in 0..3000 {
            let mut bytes = Vec::new();
            for message in other.take_outgoing() {
                encoder.encode(&message, &mut bytes);
            }
            self.world.receive(port, &bytes);
            self.step();
            let mut heard = Vec::new();
            self.world.take_output(port, &mut heard);
            decoder.push(&heard);
            while let Some(frame) = decoder.next_frame() {
                other.receive(&frame, self.now);
            }
            other.poll(self.now);
            if let Some(items) = known(other.vehicle(), kind) {
                self.world.disconnect(port);
                return items;
            }
        }
        panic!("the vehicle does not answer");
    }
}

fn hands_out(rig: &Rig) -> bool {
    crate::session::logs::hands_out_files(rig.session.vehicle())
}

#[test]
fn every_list_goes_up_is_held_comes_down_and_is_cleared() {
    for by_file in [true, false] {
        let mut rig = Rig::new(by_file);
        for kind in ListKind::ALL {
            let items = list(kind, 9, 1.0);
            rig.file("a", kind, &items);
            rig.upload(kind, "a");
            assert_eq!(rig.ended(s(30)), RowState::Done, "{:?}", rig.row);
            assert!(rig.percent >= 70);
            let held = rig.on_board(kind);
            let sent = whole(&rig.shelf.read("a").expect("it is there"), kind);
            assert!(compare::is_held(kind, &sent, &held), "{held:?}");
            rig.upload(kind, "a");
            assert_eq!(rig.ended(s(30)), RowState::Done);
            assert!(
                rig.explanation().contains("were already on board"),
                "{}",
                rig.explanation()
            );
            let file = "v{id}".to_owned();
            rig.order(kind, PlanDeed::Download { file });
            assert_eq!(rig.ended(s(30)), RowState::Done);
            let saved = rig.shelf.read("v1").expect("saved");
            let saved = whole(&saved, kind);
            assert!(compare::is_same(kind, &saved, &held));
            rig.order(kind, PlanDeed::Clear);
            assert_eq!(rig.ended(s(30)), RowState::Done);
            assert!(compare::own(kind, &rig.on_board(kind)).is_empty());
        }
    }
}

#[test]
fn a_draft_goes_on_board_without_a_file() {
    let mut rig = Rig::new(true);
    let mut document = Document::default();
    for kind in ListKind::ALL {
        *document.list_mut(kind) = list(kind, 5, 2.0);
    }
    let document = Arc::new(document);
    for kind in ListKind::ALL {
        let source = PlanSource::Document(Arc::clone(&document));
        rig.order(kind, PlanDeed::Upload { source });
        assert_eq!(rig.ended(s(30)), RowState::Done, "{:?}", rig.row);
        let held = rig.on_board(kind);
        assert!(compare::is_held(kind, &whole(&document, kind), &held));
    }
}

#[test]
fn what_the_vehicle_would_refuse_is_not_sent() {
    let mut rig = Rig::new(true);
    let mut items = list(ListKind::Plan, 6, 1.0);
    items[4].command = 195;
    rig.file("bad", ListKind::Plan, &items);
    for file in ["bad", "missing"] {
        rig.upload(ListKind::Plan, file);
        assert_eq!(rig.ended(s(1)), RowState::Refused);
    }
    rig.upload(ListKind::Fence, "bad");
    assert_eq!(rig.ended(s(1)), RowState::Refused);
    assert!(compare::own(ListKind::Plan, &rig.on_board(ListKind::Plan)).is_empty());
}

#[test]
fn a_list_that_another_program_has_changed_is_replaced_only_by_a_second_order() {
    let mut rig = Rig::new(true);
    for (file, seed) in [("a", 1.0), ("b", 2.0), ("c", 3.0)] {
        rig.file(file, ListKind::Rally, &list(ListKind::Rally, 5, seed));
    }
    rig.upload(ListKind::Rally, "a");
    rig.ended(s(30));
    rig.pass(s(10));
    // Another program's upload of the same length, which the console has not noticed.
    let before = rig.session.clone();
    rig.upload(ListKind::Rally, "b");
    rig.ended(s(30));
    rig.session = before;
    rig.pass(s(1));
    rig.upload(ListKind::Rally, "c");
    assert_eq!(rig.ended(s(30)), RowState::Refused);
    assert!(
        rig.explanation().contains("changed since it was read"),
        "{}",
        rig.explanation()
    );
    rig.upload(ListKind::Rally, "c");
    assert_eq!(rig.ended(s(30)), RowState::Done);
}

/// What the console has said since the last call, as text.
fn said(rig: &mut Rig) -> Vec<String> {
    let notices = std::mem::take(&mut rig.notices);
    notices.iter().map(|it| it.text.to_string()).collect()
}

/// The results of many transfers over a link that loses messages and is cut once.
#[derive(Debug, Default, PartialEq, Eq)]
struct Tally {
    new: usize,
    old: usize,
}

/// Uploads two lists in turn over a link that loses 30 % and is cut at a random moment of each transfer.
fn cut(kind: ListKind, by_file: bool, cuts: u64) -> Tally {
    // Item by item, reading the list on board alone takes most of a minute over such a link.
    let longest_ms = if by_file { 15_000 } else { 90_000 };
    let mut rig = Rig::new(by_file);
    let mut random = ChaCha8Rng::seed_from_u64(7 + cuts);
    let lists = [list(kind, 12, 1.0), list(kind, 17, 2.0)];
    rig.file("0", kind, &lists[0]);
    rig.file("1", kind, &lists[1]);
    rig.upload(kind, "0");
    assert_eq!(rig.ended(s(60)), RowState::Done);
    let mut tally = Tally::default();
    let mut held = 0;
    for round in 0..cuts {
        let wanted = 1 - held;
        rig.radio(0.3, 100, round);
        rig.upload(kind, &wanted.to_string());
        rig.pass(Duration::from_millis(random.random_range(0..longest_ms)));
        if !rig.state().is_some_and(RowState::is_final) {
            rig.radio(1.0, 100, round);
            rig.pass(Duration::from_millis(random.random_range(200..14_000)));
            rig.radio(0.3, 100, round + 1);
        }
        let state = rig.ended(s(600));
        rig.radio(0.0, 0, 0);
        let board = rig.on_board(kind);
        let has = |list: usize| {
            let document = rig.shelf.read(&list.to_string()).expect("it is there");
            compare::is_held(kind, &whole(&document, kind), &board)
        };
        assert!(
            has(0) != has(1),
            "round {round}: neither, {board:?}, {:?}",
            rig.row
        );
        let is_new = has(wanted);
        assert_eq!(
            is_new,
            state == RowState::Done,
            "round {round}: {:?}",
            rig.row
        );
        assert!(!rig.explanation().contains("not known"));
        if is_new {
            tally.new += 1;
            held = wanted;
        } else {
            tally.old += 1;
        }
        // Nothing that is still under way may change it later.
        rig.pass(s(10));
        let later = rig.on_board(kind);
        assert!(compare::is_same(kind, &board, &later), "round {round}");
    }
    tally
}

#[test]
fn a_plan_by_file_is_old_or_new_after_any_cut() {
    let tally = cut(ListKind::Plan, true, 30);
    assert!(tally.new >= 10 && tally.old >= 1, "{tally:?}");
}

#[test]
fn a_plan_by_items_is_old_or_new_after_any_cut() {
    let tally = cut(ListKind::Plan, false, 30);
    assert!(tally.new >= 10 && tally.old >= 1, "{tally:?}");
}

#[test]
fn a_fence_and_rally_points_are_old_or_new_after_any_cut() {
    for kind in [ListKind::Fence, ListKind::Rally] {
        for by_file in [true, false] {
            let tally = cut(kind, by_file, 8);
            assert!(tally.new >= 1, "{tally:?}");
        }
    }
}

#[test]
#[ignore = "takes minutes: run it after a change of the transfer"]
fn two_hundred_cuts_of_each_list_each_way() {
    for kind in ListKind::ALL {
        for by_file in [true, false] {
            let tally = cut(kind, by_file, 200);
            assert_eq!(tally.new + tally.old, 200);
            println!("{kind:?}, by file {by_file}: {tally:?}");
        }
    }
}
