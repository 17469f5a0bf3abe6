//! A session at one end of a link, a simulated vehicle at the other, and files in memory.

use std::collections::BTreeMap;
use std::sync::Mutex;

use mavlink::dialects::ardupilotmega::{HEARTBEAT_DATA, MavMessage, PARAM_SET_DATA};

use super::*;
use crate::language;
use crate::ledger::EntryId;
use crate::notice::Notice;
use crate::session::{RadioFault, Report, Session, Want};
use crate::sim::{PortId, Start, World, WorldConfig};
use crate::wire::{Decoder, Encoder, Outgoing};

/// Files in memory.
#[derive(Debug, Default)]
pub(super) struct Shelf(pub(super) Mutex<BTreeMap<String, Document>>);

impl PlanShelf for Shelf {
    fn read(&self, file: &str) -> Result<PlanOnFile, Text> {
        let files = self.0.lock().expect("no panic");
        let document = files.get(file).cloned();
        let noted = ListKind::ALL.into_iter().filter(|_| file == "noted");
        Ok(PlanOnFile {
            document: document.ok_or_else(|| Text::verbatim("no such file"))?,
            notes: noted
                .map(|kind| (kind, Text::verbatim(format!("about {kind:?}"))))
                .collect(),
        })
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

pub(super) fn kept_name(vehicle: VehicleId, kind: ListKind) -> String {
    format!("kept {vehicle} {kind:?}")
}

/// A session, and a simulated vehicle at its other end.
pub(super) struct Rig {
    pub(super) world: World,
    pub(super) port: PortId,
    pub(super) decoder: Decoder,
    pub(super) encoder: Encoder,
    pub(super) session: Session,
    pub(super) shelf: Arc<Shelf>,
    pub(super) now: Duration,
    pub(super) entries: u32,
    pub(super) row: Option<RowUpdate>,
    /// The highest progress of the order.
    pub(super) percent: u8,
    pub(super) notices: Vec<Notice>,
}

impl Rig {
    /// A vehicle that is ready, and a session that has read its lists.
    pub(super) fn new(by_file: bool) -> Self {
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

    /// Sets `BRD_OPTIONS` so that the vehicle neither offers nor answers MAVFTP, and starts a new
    /// session, which requests the capabilities again.
    pub(super) fn refuse_files(&mut self) {
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

    pub(super) fn say(&mut self, message: &Outgoing) {
        let mut bytes = Vec::new();
        self.encoder.encode(message, &mut bytes);
        self.world.receive(self.port, &bytes);
    }

    pub(super) fn step(&mut self) {
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
                Report::Folder(_) => {}
            }
        }
    }

    pub(super) fn pass(&mut self, time: Duration) {
        let until = self.now + time;
        while self.now < until {
            self.step();
        }
    }

    pub(super) fn radio(&mut self, loss: f64, delay_ms: u64, seed: u64) {
        self.session.carry_out(Want::Radio(RadioFault {
            loss,
            delay: Duration::from_millis(delay_ms),
            seed,
        }));
    }

    pub(super) fn file(&self, name: &str, kind: ListKind, items: &[Item]) {
        let mut document = Document::default();
        *document.list_mut(kind) = items.to_vec();
        let mut files = self.shelf.0.lock().expect("no panic");
        files.insert(name.to_owned(), document);
    }

    pub(super) fn order(&mut self, kind: ListKind, deed: PlanDeed) {
        self.entries += 1;
        self.row = None;
        self.percent = 0;
        let verb = language::verb("plan").expect("a verb");
        let command = Command::Plan(PlanCommand { kind, deed });
        let order = VehicleCommand::new(EntryId(self.entries), verb, command);
        self.session.order(order, self.now);
    }

    pub(super) fn upload(&mut self, kind: ListKind, file: &str) {
        let file = file.to_owned();
        let source = PlanSource::File(file);
        self.order(kind, PlanDeed::Upload { source });
    }

    pub(super) fn state(&self) -> Option<RowState> {
        self.row.as_ref().map(|row| row.state)
    }

    pub(super) fn explanation(&self) -> String {
        let row = self.row.as_ref().expect("a row");
        row.explanation
            .as_ref()
            .map(Text::to_string)
            .unwrap_or_default()
    }

    /// Waits for the end of the order.
    pub(super) fn ended(&mut self, within: Duration) -> RowState {
        let until = self.now + within;
        while !self.state().is_some_and(RowState::is_final) {
            assert!(self.now < until, "no end: {:?}", self.row);
            self.step();
        }
        self.state().expect("a row")
    }

    /// The vehicle's lists, as another program reads them over a good link.
    pub(super) fn on_board(&mut self, kind: ListKind) -> Vec<Item> {
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
