//! Drafts of plans on the map: lines, fences, rally points, and the cursor.

use ratatui::buffer::Buffer;

use super::board::NumberSpots;
use super::canvas::{Canvas, Stroke};
use super::ground::{keep_out_sign, label_kind, named_places, outline, sign, stroke};
use super::labels::{self, Label, LabelKind};
use super::{draw_cursor, draw_nowhere, legend, markers};
use crate::app::State;
use crate::app::room::map::{SketchKind, sketches};
use crate::app::room::plans::{Drawing, pace};
use crate::draft::{Draft, TrialFlight, areas, place, profile};
use crate::geo::{GridSize, LatLon, Outline, Viewport};
use crate::plan::{Document, Item, ListKind, command};
use crate::rehearsal::Approach;
use crate::ui::look::Badge;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::told_apart;

/// The width of a draft's name at a conflict, in columns.
const NAME_COLUMNS: usize = 8;

/// Draws the drafts over the ground, the current one last.
pub fn draw(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    let room = state.rooms().plans();
    let size = GridSize::new(panel.area.width, panel.area.height);
    let Some(view) = room.map().view(size) else {
        return draw_nowhere(panel, buffer);
    };
    let mut board = Board {
        view: &view,
        canvas: Canvas::new(size, panel.look.symbols),
        labels: Vec::new(),
    };
    board.ground(state);
    let current = room.drafts().current_index();
    let drafts = room.drafts().all().iter().enumerate();
    for (_, draft) in drafts.clone().filter(|(index, _)| *index != current) {
        board.other(state, draft);
    }
    for (_, draft) in drafts.filter(|(index, _)| *index == current) {
        board.current(state, draft);
    }
    board.conflicts(room);
    let Board { canvas, labels, .. } = board;
    canvas.draw(panel, buffer);
    let vehicles = markers::draw(state, &view, panel, NumberSpots::Beside, buffer);
    labels::draw(labels, &vehicles.cells, panel, buffer);
    legend::draw_scale(panel.look, &view, panel.area, buffer);
    draw_cursor(state, &view, room.map().pointed(&view), panel, buffer);
}

struct Board<'a> {
    view: &'a Viewport,
    canvas: Canvas,
    labels: Vec<Label>,
}

impl Board<'_> {
    fn line(&mut self, from: LatLon, to: LatLon, stroke: Stroke) {
        let (from, to) = (self.view.dot(from), self.view.dot(to));
        self.canvas.line(from, to, stroke);
    }

    /// Draws a closed line, with a sign in the middle of an area to stay out of.
    fn outline(&mut self, kind: SketchKind, corners: &[LatLon], stroke: Stroke) {
        outline(corners, self.view, &mut self.canvas, stroke);
        if kind == SketchKind::KeepOut {
            self.labels.extend(keep_out_sign(corners, self.view));
        }
    }

    fn label(&mut self, place: LatLon, kind: LabelKind, text: String, role: Role) {
        let cell = self.view.cell(place);
        self.labels.extend(cell.map(|cell| Label {
            cell,
            kind,
            text,
            role,
        }));
    }

    fn home(&mut self, place: LatLon) {
        self.label(place, LabelKind::Word, "H".to_owned(), Role::Title);
    }

    /// Draws areas, homes and the lists on board the vehicles, without numbers.
    fn ground(&mut self, state: &State) {
        for sketch in sketches(state) {
            // The lists on board must not look like a draft.
            let stroke = match sketch.kind {
                SketchKind::Plan | SketchKind::Leg => Stroke::sparse(Role::Muted),
                kind => stroke(kind),
            };
            let points = &sketch.points;
            if sketch.closed {
                self.outline(sketch.kind, points, stroke);
                let is_area = !sketch.label.is_empty();
                if let Some(corner) = points.first().filter(|_| is_area) {
                    let name = format!("{}{}", sign(sketch.kind), sketch.label);
                    self.label(*corner, label_kind(sketch.kind), name, stroke.role);
                }
            } else {
                for pair in points.windows(2) {
                    self.line(pair[0], pair[1], stroke);
                }
            }
        }
        for (name, place) in named_places(state) {
            self.label(place, LabelKind::Place, format!("+{name}"), Role::Info);
        }
        let vehicles = state.session().vehicles().values();
        for home in vehicles.filter_map(|vehicle| vehicle.home) {
            self.home(home.at_point);
        }
    }

    /// Draws the places where drafts come too close to each other in the last rehearsal.
    fn conflicts(&mut self, room: &Drawing) {
        let conflicts = room.flight().into_iter().flat_map(TrialFlight::conflicts);
        let sign = sign(SketchKind::Meeting);
        let names = told_apart(&room.pilots(), NAME_COLUMNS);
        let label = |pair: &Approach| {
            let [a, b] = [pair.a, pair.b].map(|at| names.get(at).map_or("", String::as_str));
            Some(Label {
                cell: self.view.cell(pair.place)?,
                kind: label_kind(SketchKind::Meeting),
                text: format!("{sign}{a}/{b}"),
                role: Role::Danger,
            })
        };
        let conflicts = conflicts.filter_map(label).collect();
        self.labels
            .extend(labels::spread(conflicts, self.view.rows));
    }

    /// Draws a draft other than the current one: its line and its sign.
    fn other(&mut self, state: &State, draft: &Draft) {
        let badge = Badge::of_draft(draft);
        let way = way(state, draft.document());
        for pair in way.windows(2) {
            self.line(pair[0], pair[1], Stroke::dense(badge.role));
        }
        let first = way.first().copied();
        let is_away = |place: &&LatLon| first.is_some_and(|home| home.distance_m(**place) > 1.0);
        if let Some(away) = way.iter().find(is_away) {
            let name = match draft.vehicle() {
                Some(vehicle) => vehicle.to_string(),
                None => draft.short_name().to_owned(),
            };
            let text = format!("{}{name}", badge.sign);
            self.label(*away, LabelKind::Signed, text, badge.role);
        }
    }

    fn current(&mut self, state: &State, draft: &Draft) {
        let (room, document) = (state.rooms().plans(), draft.document());
        let role = Badge::of_draft(draft).role;
        self.fence(room, document);
        for pair in way(state, document).windows(2) {
            self.line(pair[0], pair[1], Stroke::solid(role));
        }
        self.jumps(&document.plan, role);
        if let Some(home) = document.home {
            self.home(LatLon::from_e7(home.x, home.y));
        }
        self.numbers(room, ListKind::Rally, &document.rally, Role::Title);
        // Numbers of both lists at once could not be told apart.
        if room.list() != ListKind::Fence {
            self.numbers(room, ListKind::Plan, &document.plan, role);
        }
    }

    fn fence(&mut self, room: &Drawing, document: &Document) {
        let items = &document.fence;
        for area in areas(items) {
            let first = items[area.start];
            let keeps_in = matches!(
                first.command,
                command::FENCE_POLYGON_INCLUSION | command::FENCE_CIRCLE_INCLUSION
            );
            let kind = if keeps_in {
                SketchKind::Fence
            } else {
                SketchKind::KeepOut
            };
            let corners = if command::is_circle(first.command) {
                let circle = Outline::Circle {
                    centre: first.point(),
                    radius_m: f64::from(first.params[0]),
                };
                circle.corners()
            } else {
                items[area].iter().map(Item::point).collect()
            };
            self.outline(kind, &corners, stroke(kind));
        }
        // The corners matter only while they are being changed.
        if room.list() == ListKind::Fence {
            self.numbers(room, ListKind::Fence, items, Role::Fence);
        }
    }

    /// Draws a line for each jump, to the item that it leads to.
    fn jumps(&mut self, plan: &[Item], role: Role) {
        for (at, item) in plan.iter().enumerate() {
            let is_jump = item.command == command::DO_JUMP;
            let target = plan.get((item.params[0] as usize).wrapping_sub(1));
            let from = plan[..at].iter().rev().find_map(place);
            if let (true, Some(from), Some(to)) = (is_jump, from, target.and_then(place)) {
                self.line(from, to, Stroke::sparse(role));
            }
        }
    }

    /// Draws the numbers of a list's items; those that keys would change stand out.
    fn numbers(&mut self, room: &Drawing, list: ListKind, items: &[Item], role: Role) {
        let marked = room.marked().filter(|_| room.list() == list);
        let (kind, prefix) = match list {
            ListKind::Plan | ListKind::Fence => (LabelKind::Number, ""),
            ListKind::Rally => (LabelKind::Word, "R"),
        };
        let mut last = Vec::new();
        let numbered = (1..).zip(items);
        for (number, here) in numbered.filter_map(|(number, item)| Some((number, place(item)?))) {
            let is_marked = marked.is_some_and(|it| (it.first..=it.last).contains(&number));
            let text = format!("{prefix}{number}");
            // Later labels take precedence where there is no room for all.
            if is_marked {
                last.push((here, text));
            } else {
                self.label(here, kind, text, role);
            }
        }
        for (here, text) in last {
            self.label(here, kind, text, Role::Selected);
        }
    }
}

/// The places along the path of a plan, beginning with home.
fn way(state: &State, document: &Document) -> Vec<LatLon> {
    let course = profile(document, pace(state), state.rooms().plans().ground());
    let home = document.home.map(|home| LatLon::from_e7(home.x, home.y));
    let home = home.filter(|_| !course.stops.is_empty());
    let stops = course.stops.iter().map(|stop| stop.place);
    home.into_iter().chain(stops).collect()
}
