//! Missions compared with flights of a real vehicle.

mod any;
mod flown;
mod rejoin;
mod rules;

use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage, MavResult};

use super::AutoPlan;
use crate::autopilot::Autopilot;
use crate::plan::{Item, ListKind};
use crate::tests::{Ground, start};
use crate::vehicle::Vehicle;

const AUTO: f32 = 3.0;
const GUIDED: f32 = 4.0;
const LAND: f32 = 9.0;

/// An item without a place, at a height above home.
fn act(command: u16, p: [f32; 4], height_m: f32) -> Item {
    Item {
        command,
        frame: 3,
        auto_continue: true,
        params: p,
        z: height_m,
        ..Item::default()
    }
}

/// An item of frame 3 (above home); its place is given in metres north and east of the start.
fn at(command: u16, north_m: f64, east_m: f64, height_m: f32) -> Item {
    let (x, y) = start().at.moved(north_m, east_m).to_e7();
    Item {
        x,
        y,
        ..act(command, [0.0; 4], height_m)
    }
}

fn with(item: Item, p: [f32; 4]) -> Item {
    Item { params: p, ..item }
}

impl Ground {
    fn autopilot(&mut self) -> &mut Autopilot {
        &mut self.world.slots[0].autopilot
    }

    fn with_plan(&mut self, work: impl FnOnce(&mut AutoPlan, &mut Vehicle) -> bool) {
        let Autopilot {
            vehicle, auto_plan, ..
        } = self.autopilot();
        work(auto_plan, vehicle);
    }

    /// Stores a mission, with home as its first item.
    fn load(&mut self, items: &[Item]) {
        let mut list = vec![at(16, 0.0, 0.0, 0.0)];
        list.extend_from_slice(items);
        self.autopilot().vehicle.plans.mission = list;
    }

    fn mode(&mut self, mode: f32) -> MavResult {
        self.long(MavCmd::MAV_CMD_DO_SET_MODE, [1.0, mode])
    }

    #[expect(deprecated, reason = "ground stations in use still send it")]
    fn set_current(&mut self, seq: u16) {
        self.say(MavMessage::MISSION_SET_CURRENT(
            mavlink::dialects::ardupilotmega::MISSION_SET_CURRENT_DATA {
                seq,
                target_system: 1,
                target_component: 1,
            },
        ));
    }

    fn start_mission(&mut self) -> MavResult {
        self.long(MavCmd::MAV_CMD_MISSION_START, [])
    }

    fn current(&mut self) -> (u16, u16, u8, u8) {
        let Some(MavMessage::MISSION_CURRENT(data)) =
            crate::autopilot::telemetry::message(42, self.autopilot())
        else {
            panic!("no MISSION_CURRENT")
        };
        (
            data.seq,
            data.total,
            data.mission_state as u8,
            data.mission_mode,
        )
    }

    /// The mission's messages since the last call, in order: texts, and reached items as "R n".
    fn news(&mut self) -> Vec<String> {
        let said = self
            .messages_since(0)
            .into_iter()
            .filter_map(|message| match message {
                MavMessage::STATUSTEXT(data) => {
                    let text = data.text.to_str().expect("text").to_owned();
                    (!text.starts_with("EKF3") && !text.starts_with("SIM")).then_some(text)
                }
                MavMessage::MISSION_ITEM_REACHED(data) => Some(format!("R {}", data.seq)),
                _ => None,
            })
            .collect();
        self.heard.clear();
        said
    }

    /// Runs until the next message; returns the time it took, and the messages of that step.
    fn next_news(&mut self, most_s: f64) -> (f64, Vec<String>) {
        let mut elapsed = 0.0;
        while elapsed < most_s {
            self.step();
            elapsed += 0.01;
            let news = self.news();
            if !news.is_empty() {
                return (elapsed, news);
            }
        }
        panic!("silent for {most_s} s: {:?}", self.truth());
    }
}

/// A vehicle armed in GUIDED, with a mission.
fn ready_with(items: &[Item]) -> Ground {
    let mut ground = Ground::armed();
    ground.load(items);
    ground.heard.clear();
    ground
}
