//! Two flights of a mission beside each other, at the same mission time.

use std::time::Duration;

use ratatui::buffer::Buffer;
use ratatui::text::{Line, Span};

use crate::app::State;
use crate::app::room::class::ReplayedFlights;
use crate::app::state::Ghost;
use crate::comparison::ComparedFlight;
use crate::geo::LatLon;
use crate::mission::AreaKind;
use crate::text;
use crate::text::{Text, clock};
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::{MapSign, PlainMap, Stroke};
use crate::ui::widget::{clip, put, wrap};

/// The share of the height that the map has, in percent, and the least rows below it.
const MAP_SHARE: u16 = 60;
const LEAST_ROWS: u16 = 7;
/// The maximum number of bookmarks shown of each flight.
const BOOKMARKS: usize = 4;

pub fn draw(state: &State, flights: &ReplayedFlights, panel: Panel<'_>, buffer: &mut Buffer) {
    let progress = state.session().mission();
    let elapsed = progress.map_or(Duration::ZERO, |it| it.elapsed);
    let Some((ghost, own)) = state.ghost().and_then(|it| Some((it, it.own.as_deref()?))) else {
        let text = panel.say("class-replay-reading");
        for (row, line) in (0..).zip(wrap(&text, panel.width())) {
            let line = Line::styled(line, panel.style(Role::Muted));
            put(buffer, panel.area, row, &line);
        }
        return;
    };
    // Maps of the same size have the same scale.
    let half = panel.area.width.saturating_sub(1) / 2;
    let view = FlightAtTime {
        state,
        ghost,
        flight: own,
        trainee: &flights.own,
        time: Some(elapsed),
    };
    view.draw(panel.columns(0, half), buffer);
    let other = FlightAtTime {
        flight: &ghost.other,
        trainee: &flights.other,
        time: ghost.time(elapsed),
        ..view
    };
    other.draw(panel.columns(half + 1, half), buffer);
}

/// A flight at a moment.
struct FlightAtTime<'a> {
    state: &'a State,
    ghost: &'a Ghost,
    flight: &'a ComparedFlight,
    trainee: &'a str,
    /// The mission time; `None` before the start of this flight.
    time: Option<Duration>,
}

impl FlightAtTime<'_> {
    fn draw(&self, panel: Panel<'_>, buffer: &mut Buffer) {
        let score = self.flight.report.score;
        let title = text!("class-replay-title", trainee = self.trainee, score = score);
        let inner = panel.titled(&panel.text(&title), buffer);
        let panel = panel.at(inner);
        let map_rows =
            (inner.height * MAP_SHARE / 100).min(inner.height.saturating_sub(LEAST_ROWS));
        self.map().draw(panel.upper(map_rows), buffer);
        let rest = panel.below(map_rows);
        for (row, (text, role)) in (0..rest.area.height).zip(self.lines()) {
            let text = clip(&panel.text(&text), rest.width());
            let line = Line::from(Span::styled(text, panel.style(role)));
            put(buffer, rest.area, row, &line);
        }
    }

    /// The map; both flights have the same one, so that places can be compared.
    fn map(&self) -> PlainMap {
        let time = self.time.unwrap_or_default();
        let whole = |flight: &ComparedFlight| {
            let ways = flight.ways(flight.length);
            ways.flatten().collect::<Vec<LatLon>>()
        };
        let mut others = whole(&self.ghost.other);
        others.extend(self.ghost.own.iter().flat_map(|own| whole(own)));
        let progress = self.state.session().mission();
        let areas = progress.iter().flat_map(|it| &it.areas);
        let fences = areas.filter(|area| area.kind == AreaKind::Geofence);
        let mut map = PlainMap {
            fences: fences.map(|area| area.outline.corners()).collect(),
            wires: self.wires(),
            others,
            ..PlainMap::default()
        };
        for way in self.flight.ways(time) {
            map.ways.push((Stroke::dotted(Role::Muted), way));
        }
        map.signs = self
            .flight
            .at(time)
            .map(|(vehicle, point)| MapSign::vehicle(point.place, vehicle))
            .collect();
        map
    }

    fn wires(&self) -> Vec<Vec<LatLon>> {
        let mission = self.state.flown_mission();
        let wires = mission.iter().flat_map(|mission| &mission.wires);
        wires.map(|wire| wire.pylons.clone()).collect()
    }

    /// The figures, the bookmarks so far with the newest first, and the objectives.
    fn lines(&self) -> Vec<(Text, Role)> {
        let Some(time) = self.time else {
            return vec![(text!("class-replay-before"), Role::Muted)];
        };
        let whole = |value: Option<f64>| value.map_or("-".to_owned(), |it| format!("{it:.0}"));
        let figures = text!(
            "class-replay-figures",
            clock = clock(time),
            height = whole(self.flight.height_m(time)),
            battery = whole(self.flight.battery_percent(time))
        );
        let is_over = time > self.flight.length;
        let over = is_over.then(|| (text!("class-replay-over"), Role::Muted));
        let bookmarks = self.flight.bookmarks.iter().rev();
        let so_far = bookmarks.filter(|it| it.at <= time).take(BOOKMARKS);
        let so_far = so_far.map(|it| {
            let text = text!(
                "class-replay-bookmark",
                clock = clock(it.at),
                text = it.text.as_str()
            );
            (text, Role::Accent)
        });
        let objectives = self.state.session().mission();
        let objectives = objectives.map_or(&[][..], |it| &it.objectives);
        let reached = objectives.iter().zip(self.flight.reached_by(time));
        let reached = reached.map(|(objective, is_met)| {
            let title = objective.title.clone();
            if is_met {
                (text!("class-replay-met", title = title), Role::Ok)
            } else {
                (text!("class-replay-open", title = title), Role::Text)
            }
        });
        std::iter::once((figures, Role::Muted))
            .chain(over)
            .chain(reached)
            .chain(so_far)
            .collect()
    }
}
