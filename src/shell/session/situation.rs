//! The situation of a session in the embedded simulator, from which it can continue.

use std::time::Duration;

use super::RunningSession;
use super::mission_run::{MissionRun, MissionSituation};
use crate::exercise::PacedClock;
use crate::notice::Notice;
use crate::operator::Operator;
use crate::session::Session;
use crate::sim::World;
use crate::swarm::Path;
use crate::vehicle::VehicleId;

/// Everything from which a session can continue.
pub(in crate::shell) struct SessionSituation {
    world: World,
    sessions: Vec<VehicleSession>,
    mission: Option<MissionSituation>,
    operator: Operator,
    paths: Vec<Path>,
    vehicle_time: PacedClock,
    speedup: f64,
}

struct VehicleSession {
    vehicle: VehicleId,
    session: Session,
}

impl RunningSession {
    /// The situation, while simulator and clock stand; `None` if the vehicles are not those of the embedded simulator.
    pub async fn situation(&self) -> Option<SessionSituation> {
        let world = self.world.as_ref()?.copy().await?;
        let vehicles: Vec<VehicleId> = self.vehicles.iter().map(|it| it.borrow().id).collect();
        let mut sessions = Vec::new();
        for vehicle in vehicles {
            let session = self.fleet.copy(vehicle).await?;
            sessions.push(VehicleSession { vehicle, session });
        }
        Some(SessionSituation {
            world,
            sessions,
            mission: self.mission_run.as_ref().map(MissionRun::situation),
            operator: self.operator.clone(),
            paths: self.paths.clone(),
            vehicle_time: self.vehicle_time,
            speedup: self.speedup(),
        })
    }

    /// Puts the world of a situation in the place of the present one, and ends the record: what follows is not in it.
    /// Returns the name of the mission's record, if it is complete.
    pub async fn leave_for(&mut self, situation: &SessionSituation) -> Option<String> {
        if let Some(world) = &self.world {
            world.replace(situation.world.clone()).await;
        }
        let record = self.take_record();
        if let Some(run) = &mut self.mission_run {
            run.leave_record();
        }
        if let Some(mut recorder) = self.recorder.take() {
            recorder.end(true);
        }
        record
    }

    /// Continues from a situation, with its world and on its clock, which stands at `now`; returns the mission's notice.
    pub async fn recall(&mut self, situation: &SessionSituation, now: Duration) -> Option<Notice> {
        self.rehearsals.drop_late();
        for it in &situation.sessions {
            let recalled = self.fleet.recall(it.vehicle, it.session.clone()).await;
            if recalled.is_err() {
                tracing::warn!("vehicle {}: its situation was not recalled", it.vehicle);
            }
        }
        self.operator = situation.operator.clone();
        self.paths.clone_from(&situation.paths);
        self.vehicle_time = situation.vehicle_time;
        self.pace
            .send_modify(|pace| pace.speedup = situation.speedup);
        let run = self.mission_run.as_mut()?;
        let notice = run.recall(situation.mission.as_ref()?)?;
        Some(Notice { at: now, ..notice })
    }
}
