//! Makes a plan for each vehicle from an order.

use glam::{DVec2, DVec3};

use super::Call;
use super::act::{ActiveManoeuvre, Work, WorldView};
use super::site::Site;
use super::transit::MARGIN_M;
use crate::commands::{Datum, FarEnd, Manoeuvre, ready_for, suits};
use crate::geo::LatLon;
use crate::ledger::{RowState, RowUpdate};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

mod plans;

/// The default distance between neighbours of a formation.
const FORMATION_SPACING_M: f64 = 10.0;
/// The default extent of an expanding square, in multiples of the spacing.
pub(super) const SQUARE_TURNS: f64 = 5.0;

/// The planning of one manoeuvre: its order, the vehicles that can take part, and the resulting
/// rows.
pub(super) struct Planner<'a> {
    view: WorldView<'a>,
    call: Call<'a>,
    /// The vehicles that can take part, with their positions.
    team: Vec<(VehicleId, DVec3)>,
    site: Site,
    /// Remarks for the rows of the vehicles.
    remarks: Vec<Text>,
    pub rows: Vec<RowUpdate>,
}

type Made = Result<ActiveManoeuvre, Text>;

impl<'a> Planner<'a> {
    pub fn new(view: WorldView<'a>, call: Call<'a>) -> Self {
        let mut globals = call
            .targets
            .iter()
            .filter_map(|id| view.vehicles.get(id)?.global);
        let origin = globals.next().map(|global| global.at_point);
        Self {
            view,
            call,
            team: Vec::new(),
            site: Site::new(origin.unwrap_or(LatLon::new(0.0, 0.0))),
            remarks: Vec::new(),
            rows: Vec::new(),
        }
    }

    /// Selects the vehicles that can take part, and refuses the others.
    pub fn pick_team(&mut self) {
        let verb = self.call.verb;
        for &id in self.call.targets {
            let fitness = match self.view.vehicles.get(&id) {
                None => Err(text!("refused-not-heard")),
                Some(_) if self.is_its_own_goal(id) => Err(text!("swarm-its-own-goal")),
                Some(vehicle) => {
                    suits(verb, vehicle, false).and_then(|()| ready_for(verb.name, vehicle))
                }
            };
            let vehicle = self.view.vehicles.get(&id);
            let at = vehicle.and_then(|vehicle| self.site.point(vehicle));
            match (fitness, at) {
                (Ok(()), Some(at)) => self.team.push((id, at)),
                (Ok(()), None) => {}
                (Err(reason), _) => self.tell(id, RowState::Refused, Some(reason)),
            }
        }
    }

    fn is_its_own_goal(&self, id: VehicleId) -> bool {
        match *self.call.manoeuvre {
            Manoeuvre::Follow { leader, .. } => leader == id,
            Manoeuvre::Chain {
                to: FarEnd::Vehicle(to),
                ..
            } => to == id,
            Manoeuvre::Chain {
                to: FarEnd::Place(_),
                ..
            }
            | Manoeuvre::Survey { .. }
            | Manoeuvre::Formation { .. }
            | Manoeuvre::Disband
            | Manoeuvre::Spread { .. }
            | Manoeuvre::Search { .. } => false,
        }
    }

    /// The vehicles that can take part.
    pub fn team(&self) -> Vec<VehicleId> {
        self.team.iter().map(|(id, _)| *id).collect()
    }

    fn tell(&mut self, vehicle: VehicleId, state: RowState, explanation: Option<Text>) {
        self.rows.push(RowUpdate {
            entry: self.call.entry,
            vehicle,
            state,
            tries: 1,
            at: self.view.now,
            explanation,
        });
    }

    /// Plans the manoeuvre; `None` if no vehicle can do it, with the reasons in the rows.
    pub fn make(&mut self) -> Option<ActiveManoeuvre> {
        if self.team.is_empty() {
            return None;
        }
        match self.plan() {
            Ok(act) => {
                let remark = (!self.remarks.is_empty())
                    .then(|| Text::joined("; ", std::mem::take(&mut self.remarks)));
                for member in &act.members {
                    self.tell(member.id, RowState::InProgress(0), remark.clone());
                }
                Some(act)
            }
            Err(reason) => {
                for id in self.team() {
                    self.tell(id, RowState::Refused, Some(reason.clone()));
                }
                None
            }
        }
    }

    fn plan(&mut self) -> Made {
        match self.call.manoeuvre {
            Manoeuvre::Survey {
                ground,
                spacing_m,
                up_m,
                course_deg,
            } => self.survey(ground, *spacing_m, self.height(*up_m), *course_deg),
            &Manoeuvre::Formation {
                shape,
                spacing_m,
                up_m,
                face_deg,
            } => self.formation(shape, spacing_m, self.height(up_m), face_deg),
            &Manoeuvre::Follow {
                leader,
                distance_m,
                up_m,
            } => self.follow(leader, distance_m, up_m),
            &Manoeuvre::Spread { spacing_m } => self.spread(spacing_m),
            &Manoeuvre::Search {
                pattern,
                datum,
                radius_m,
                spacing_m,
                up_m,
            } => self.search(pattern, datum, radius_m, spacing_m, self.height(up_m)),
            &Manoeuvre::Chain { to, up_m } => self.chain(to, self.height(up_m)),
            Manoeuvre::Disband => Err(text!("swarm-no-formation")),
        }
    }

    fn act(&self, work: Work) -> ActiveManoeuvre {
        ActiveManoeuvre::new(self.call.entry, self.call.verb, self.site, work)
    }

    /// The requested height, or that of the first vehicle.
    fn height(&self, up_m: Option<f64>) -> f64 {
        up_m.unwrap_or_else(|| self.team.first().map_or(0.0, |(_, at)| at.z))
    }

    fn spot(&self, spot: Datum) -> Result<DVec2, Text> {
        let first = self
            .team
            .first()
            .and_then(|(id, _)| self.view.vehicles.get(id));
        let found = first.and_then(|first| self.site.spot(spot, first));
        found.ok_or_else(|| text!("refused-no-position"))
    }

    /// The requested spacing of the lines, otherwise the default at a height, with a remark.
    fn line_spacing(&mut self, spacing_m: Option<f64>, up_m: f64) -> f64 {
        spacing_m.unwrap_or_else(|| {
            let metres = self.view.rules.line_spacing_m(up_m);
            let figure = format!("{metres:.1}");
            self.remarks.push(match self.view.rules.strip_m(up_m) {
                Some(_) => text!("swarm-swath-spacing", metres = figure),
                None => text!("swarm-usual-spacing", metres = figure),
            });
            metres
        })
    }

    /// Checks a spacing, and returns it.
    ///
    /// # Errors
    /// The spacing is below the separation with its margin, and there are several vehicles.
    fn roomy(&self, spacing_m: f64) -> Result<f64, Text> {
        let separation_m = self.view.rules.separation_m;
        let least = separation_m + MARGIN_M;
        if spacing_m + 1e-9 < least && self.team.len() > 1 {
            return Err(text!(
                "swarm-too-near",
                spacing = format!("{spacing_m:.1}"),
                least = format!("{least:.1}"),
                separation = format!("{separation_m:.1}")
            ));
        }
        Ok(spacing_m)
    }
}
