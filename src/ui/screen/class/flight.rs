//! What is behind the screen of a watched seat: how its mission stands, where its vehicles are in truth, and what
//! happened.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use super::detail::{armed, draw_lines, events, taken};
use super::seat_view::SeatLineView;
use crate::class::{
    Desk, FlightReport, Insight, InsightPlace, ObjectiveInsight, ObjectiveStanding, SeatRecord,
    VehicleInsight,
};
use crate::geo::LatLon;
use crate::text;
use crate::text::{Text, clock};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::{MapSign, PlainMap, Stroke};
use crate::ui::widget::{clip, put, width};

/// The origin of the places: they are known only in metres from that of the mission.
const ORIGIN: LatLon = LatLon::new(0.0, 0.0);
/// From this distance on, it is said that a trainee sees a vehicle elsewhere; below, telemetry is only late.
const ELSEWHERE_M: f64 = 15.0;
/// The least width from which a map stands beside the lines.
const MAP_FROM: u16 = 54;
/// The share of the width that the map has beside the lines, in percent.
const MAP_SHARE: u16 = 42;
/// The maximum number of orders among what happened.
const ORDERS: usize = 2;
/// The least height at which the map stands above the lines in a place that is narrow or tall.
const TALL: u16 = 24;

/// A watched seat as it is drawn.
pub(super) struct FlightView<'a> {
    pub desk: &'a Desk,
    pub seat: &'a SeatRecord,
    pub now: Duration,
}

impl FlightView<'_> {
    /// Draws the state, and the map beside it or above it, as far as there is room.
    pub fn draw(&self, panel: Panel<'_>, buffer: &mut Buffer) {
        put(buffer, panel.area, 0, &self.state(panel));
        let panel = panel.below(1);
        let map = self.seat.insight().map(map);
        let Some(map) = map.filter(|map| !map.signs.is_empty()) else {
            return self.draw_rows(panel, buffer);
        };
        let is_tall = panel.area.height * 2 >= panel.area.width;
        if panel.area.width >= MAP_FROM && !is_tall {
            let width = panel.area.width * MAP_SHARE / 100;
            map.draw(panel.columns(0, width), buffer);
            let rest = panel.columns(width + 1, panel.area.width);
            self.draw_rows(rest, buffer);
        } else if panel.area.height >= TALL {
            let rows = panel.area.height / 2;
            map.draw(panel.upper(rows), buffer);
            self.draw_rows(panel.below(rows), buffer);
        } else {
            self.draw_rows(panel, buffer);
        }
    }

    /// Why the seat needs help or what it does, and the figures of the flight.
    fn state(&self, panel: Panel<'_>) -> Line<'static> {
        let view = SeatLineView {
            desk: self.desk,
            seat: self.seat,
            now: self.now,
            look: panel.look,
        };
        let (state, role) = view.state();
        let state = clip(&state, panel.width());
        let mut line = Line::from(Span::styled(state, panel.style(role)));
        let room = panel.width().saturating_sub(line.width() + 2);
        if let Some(flight) = view.flight() {
            let long = panel.text(&figures("class-flight-figures", flight));
            let shown = if width(&long) <= room {
                long
            } else {
                panel.text(&figures("class-flight-figures-short", flight))
            };
            line.push_span("  ");
            let shown = clip(&shown, room);
            line.push_span(Span::styled(shown, panel.style(Role::Muted)));
        }
        line
    }

    /// Draws the lines, those of each kind as far as the others leave room.
    fn draw_rows(&self, panel: Panel<'_>, buffer: &mut Buffer) {
        let rows = usize::from(panel.area.height);
        let third = (rows / 3).max(1);
        let mut lines: Vec<(Text, Role)> = taken(self.seat).into_iter().collect();
        if let Some(insight) = self.seat.insight() {
            lines.extend(insight.alerts.iter().take(third.min(3)).map(alert));
            lines.extend(objectives(insight, third));
        } else if self.seat.is_here() && self.is_flying() {
            lines.push((text!("class-flight-waits"), Role::Muted));
        }
        lines.extend(armed(self.seat).take(2));
        if let Some(insight) = self.seat.insight() {
            lines.extend(vehicles(insight, third));
        }
        let lines = lines.into_iter().chain(events(self.seat, ORDERS));
        draw_lines(lines, panel, buffer);
    }

    fn is_flying(&self) -> bool {
        let report = self.seat.report.as_ref();
        report.is_some_and(|report| report.flight.is_some())
    }
}

/// The time, the score, the objectives met and the vehicles in the air, in one of two messages that differ in length.
fn figures(id: &'static str, flight: &FlightReport) -> Text {
    let arguments = vec![
        ("clock", clock(super::seconds(flight.clock_s)).into()),
        ("score", score(flight).into()),
        ("met", flight.objectives_done.into()),
        ("objectives", flight.objectives.into()),
        ("airborne", flight.airborne.into()),
        ("vehicles", flight.vehicles.into()),
    ];
    Text::new(id, arguments)
}

fn score(flight: &FlightReport) -> String {
    let score = flight.score.map(|it| it.to_string());
    score.unwrap_or_else(|| "-".to_owned())
}

fn alert(text: &crate::class::Words) -> (Text, Role) {
    (
        text!("class-flight-alert", alert = text.as_str()),
        Role::Danger,
    )
}

/// The objectives; if there is not room for all, the open ones first.
fn objectives(insight: &Insight, most: usize) -> Vec<(Text, Role)> {
    let all = &insight.objectives;
    let mut shown: Vec<usize> = (0..all.len()).collect();
    if all.len() > most {
        shown.sort_by_key(|&at| (all[at].standing != ObjectiveStanding::Open, at));
        shown.truncate(most.saturating_sub(1).max(1));
        shown.sort_unstable();
    }
    let rest = all.len() - shown.len();
    let lines = shown.into_iter().map(|at| objective(&all[at]));
    let rest = (rest > 0).then(|| (text!("class-flight-more", count = rest), Role::Muted));
    lines.chain(rest).collect()
}

fn objective(objective: &ObjectiveInsight) -> (Text, Role) {
    let (title, detail) = (objective.title.as_str(), objective.detail.as_str());
    match objective.standing {
        ObjectiveStanding::Open => (
            text!("class-flight-open", title = title, detail = detail),
            Role::Text,
        ),
        ObjectiveStanding::Met => (
            text!("class-flight-met", title = title, detail = detail),
            Role::Ok,
        ),
        ObjectiveStanding::Missed => (
            text!("class-flight-missed", title = title, detail = detail),
            Role::Warning,
        ),
    }
}

/// The vehicles, those that their trainee sees elsewhere first.
fn vehicles(insight: &Insight, most: usize) -> impl Iterator<Item = (Text, Role)> {
    let mut all: Vec<&VehicleInsight> = insight.vehicles.iter().collect();
    all.sort_by_key(|it| (elsewhere_m(it).is_none(), it.id));
    all.into_iter().take(most).map(vehicle)
}

fn vehicle(vehicle: &VehicleInsight) -> (Text, Role) {
    let dash = || "-".to_owned();
    let height = vehicle
        .place()
        .map_or_else(dash, |it| format!("{:.0}", f64::from(it.height) / 10.0));
    let battery = vehicle.battery.map_or_else(dash, |it| it.to_string());
    let line = text!(
        "class-flight-vehicle",
        vehicle = vehicle.id,
        mode = vehicle.mode.as_str(),
        height = height,
        battery = battery
    );
    match elsewhere_m(vehicle) {
        Some(metres) => {
            let seen = text!("class-flight-elsewhere", metres = metres.round() as u32);
            (Text::joined("  ", vec![line, seen]), Role::Warning)
        }
        None => (line, Role::Muted),
    }
}

/// How far from its true place the trainee sees a vehicle, if it is far.
fn elsewhere_m(vehicle: &VehicleInsight) -> Option<f64> {
    vehicle.error_m().filter(|metres| *metres >= ELSEWHERE_M)
}

/// The map of the truth: fences, targets, the vehicles where they are, and where the trainee sees those that are
/// elsewhere.
fn map(insight: &Insight) -> PlainMap {
    let fence = |corners: &Vec<InsightPlace>| corners.iter().copied().map(place).collect();
    let mut map = PlainMap {
        fences: insight.fences.iter().map(fence).collect(),
        ..PlainMap::default()
    };
    for target in &insight.targets {
        let (text, role) = if target.is_found {
            ("#", Role::Ok)
        } else {
            ("X", Role::Danger)
        };
        map.signs.push(MapSign::text(place(target.at), text, role));
    }
    for vehicle in &insight.vehicles {
        add_vehicle(vehicle, &mut map);
    }
    map
}

fn add_vehicle(vehicle: &VehicleInsight, map: &mut PlainMap) {
    let Some(here) = vehicle.place() else {
        return;
    };
    let here = place(here.at);
    if let Some(shown) = vehicle.shown.filter(|_| elsewhere_m(vehicle).is_some()) {
        let shown = place(shown.at);
        let seen = format!("?{}", vehicle.id);
        map.ways
            .push((Stroke::dotted(Role::Warning), vec![here, shown]));
        map.signs.push(MapSign::text(shown, &seen, Role::Warning));
    }
    map.signs.push(MapSign::vehicle(here, vehicle.id));
}

fn place([east, north]: InsightPlace) -> LatLon {
    ORIGIN.moved(f64::from(north) / 10.0, f64::from(east) / 10.0)
}
