//! Second senders with the system id of a known vehicle: another vehicle, or the same one over another link. Their
//! frames are not accepted; their boards' ids show which case it is.

use std::time::Duration;

use mavlink::MessageData as _;
use mavlink::dialects::ardupilotmega::{
    AUTOPILOT_VERSION_DATA, COMMAND_LONG_DATA, MavCmd, MavMessage,
};

use super::{FleetEvent, FrameSender, Hub, ToVehicle};
use crate::link::To;
use crate::notice::Notice;
use crate::text;
use crate::text::Text;
use crate::vehicle::{BoardId, Severity};
use crate::wire::{ComponentId, Content, Frame, SystemId};

/// The interval of warnings about a shared system id.
const CONFLICT_EVERY: Duration = Duration::from_secs(30);
/// How long a warning waits for the id of the second sender's board.
const BOARD_PATIENCE: Duration = Duration::from_secs(3);
/// The interval of requests for that id.
const ASK_EVERY: Duration = Duration::from_secs(1);

/// The last second sender with a vehicle's system id.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rival {
    sender: FrameSender,
    since: Duration,
    board: Option<BoardId>,
    asked_at: Option<Duration>,
    said_at: Option<Duration>,
}

/// What is due after frames of a second sender.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct RivalSteps {
    /// Ask for its board, and mark the vehicle.
    asks: bool,
    tells: bool,
}

impl Rival {
    fn new(sender: FrameSender, now: Duration) -> Self {
        Self {
            sender,
            since: now,
            board: None,
            asked_at: None,
            said_at: None,
        }
    }

    /// Takes in frames. While the links are shared, every warning waits, until it can be known whether the frames have
    /// gone round a loop.
    fn hear(&mut self, frames: &[Frame], is_shared: bool, now: Duration) -> RivalSteps {
        self.board = frames.iter().find_map(board_in).or(self.board);
        let waits = is_shared || self.board.is_none();
        let is_patient = waits && now < self.since + BOARD_PATIENCE;
        let asks = self.asked_at.is_none_or(|at| now >= at + ASK_EVERY);
        let tells = !is_patient && self.said_at.is_none_or(|at| now >= at + CONFLICT_EVERY);
        if asks {
            self.asked_at = Some(now);
        }
        if tells {
            self.said_at = Some(now);
        }
        RivalSteps { asks, tells }
    }
}

fn board_in(frame: &Frame) -> Option<BoardId> {
    match &frame.content {
        Content::Message(MavMessage::AUTOPILOT_VERSION(data)) => BoardId::of(data.uid, &data.uid2),
        Content::Message(_) | Content::Undecoded { .. } | Content::Unknown { .. } => None,
    }
}

impl Hub {
    /// Handles frames of a second sender with a vehicle's system id: asks for the id of its board, and warns.
    pub(super) async fn meet_rival(
        &mut self,
        system: SystemId,
        from: FrameSender,
        frames: &[Frame],
        now: Duration,
    ) {
        let Some(route) = self.routes.get_mut(&system) else {
            return;
        };
        let rival = match &mut route.rival {
            Some(rival) if rival.sender == from => rival,
            slot => slot.insert(Rival::new(from, now)),
        };
        let steps = rival.hear(frames, self.sharing.relay.is_used(), now);
        let board = rival.board;
        let component = route.component;
        if self.sharing.relay.is_loop(from.link, from.peer) {
            return self.name_loop(from, now).await;
        }
        if steps.asks {
            drop(route.inbox.try_send(ToVehicle::Twin));
            self.ask_board(system, component, from);
        }
        if steps.tells {
            let text = self.conflict(system, from, board);
            self.warn(system, text, now).await;
        }
    }

    /// Reports, once for each sender, that the console's own frames come back from it.
    async fn name_loop(&mut self, from: FrameSender, now: Duration) {
        if self.sharing.loops_named.insert((from.link, from.peer)) {
            let text = text!("link-loop", link = self.name_of(from));
            let notice = Notice::general(now, Severity::Notice, text);
            self.tell(FleetEvent::Warning(notice)).await;
        }
    }

    fn ask_board(&self, system: SystemId, component: ComponentId, from: FrameSender) {
        let request = MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
            target_system: system,
            target_component: component,
            command: MavCmd::MAV_CMD_REQUEST_MESSAGE,
            param1: AUTOPILOT_VERSION_DATA::ID as f32,
            ..COMMAND_LONG_DATA::DEFAULT
        });
        if let Some(link) = self.links.get(usize::from(from.link.0)) {
            link.send(To::Peer(from.peer), request.into());
        }
    }

    fn conflict(&self, system: SystemId, from: FrameSender, board: Option<BoardId>) -> Text {
        let Some(route) = self.routes.get(&system) else {
            return Text::default();
        };
        let known = route.vehicle().version.and_then(|version| version.board);
        let used = self.place_of(route.sender, known);
        let ignored = self.place_of(from, board);
        if board.is_some() && board == known {
            return text!(
                "heard-twice",
                system = system,
                used = used,
                ignored = ignored
            );
        }
        text!(
            "heard-two-places",
            system = system,
            used = used,
            ignored = ignored
        )
    }

    /// The place of a sender, with the id of its board if known.
    fn place_of(&self, sender: FrameSender, board: Option<BoardId>) -> Text {
        let place = self.name_of(sender);
        match board {
            Some(board) => text!("heard-board", place = place, board = board.to_string()),
            None => place,
        }
    }
}
