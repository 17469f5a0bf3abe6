//! The heights along the plan, above home.

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use super::Shown;
use super::list::seconds;
use crate::draft::{Draft, PlanFrame, Stop, ground_above_home};
use crate::geo::{DOTS_ACROSS, DOTS_DOWN, Dot, GridSize};
use crate::plan::{ContentHash, ListKind};
use crate::text;
use crate::text::figure;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::map::{Canvas, Stroke, length, stamp};
use crate::ui::widget::{aligned, put, row_of, width};

/// The width of the axis with the heights at the left, in columns.
const AXIS: u16 = 6;
/// The width of a title's rule and blanks, in columns.
const TITLE_ENDS: usize = 6;
/// The minimum height at the top of the scale, in metres.
const LEAST_TOP_M: f64 = 10.0;

/// The number of equal sections of the path; the ground at their ends counts for the scale.
const GROUND_STEPS: u32 = 200;

/// The height of the ground above home at a distance along the path, both in metres; `None` if it is unknown.
fn ground_m(shown: &Shown<'_>, along_m: f64) -> Option<f64> {
    let at = shown.course.place_at(along_m)?;
    ground_above_home(shown.document, at, shown.room.ground())
}

struct Scale {
    size: GridSize,
    length_m: f64,
    low_m: f64,
    high_m: f64,
}

impl Scale {
    fn of(shown: &Shown<'_>, size: GridSize) -> Self {
        let length_m = shown.course.length_m.max(1.0);
        let stops = shown.course.stops.iter().map(|stop| stop.height_m);
        let ground = (0..=GROUND_STEPS).filter_map(|step| {
            let along_m = length_m * f64::from(step) / f64::from(GROUND_STEPS);
            ground_m(shown, along_m)
        });
        let (low_m, high_m) = stops
            .chain(ground)
            .fold((0.0_f64, LEAST_TOP_M), |(low, high), height_m| {
                (low.min(height_m), high.max(height_m))
            });
        Self {
            size,
            length_m,
            low_m,
            high_m: low_m + (high_m - low_m) * 1.2,
        }
    }

    /// The distance along the path of each column of dots, in metres.
    fn columns(&self) -> impl Iterator<Item = f64> {
        let count = self.size.columns * DOTS_ACROSS;
        let step_m = self.length_m / (f64::from(count) - 1.0).max(1.0);
        (0..count).map(move |at| f64::from(at) * step_m)
    }

    fn dot(&self, along_m: f64, height_m: f64) -> Dot {
        let right = f64::from(self.size.columns * DOTS_ACROSS) - 1.0;
        let bottom = f64::from(self.size.rows * DOTS_DOWN) - 1.0;
        let share = (height_m - self.low_m) / (self.high_m - self.low_m);
        Dot::new(along_m / self.length_m * right, (1.0 - share) * bottom)
    }
}

pub(super) fn draw(shown: &Shown<'_>, draft: &Draft, panel: Panel<'_>, buffer: &mut Buffer) {
    let inner = panel.at(panel.titled(&title(shown, draft, panel), buffer));
    let curve = inner.columns(AXIS, inner.area.width.saturating_sub(AXIS + 1));
    let size = GridSize::new(curve.area.width, curve.area.height);
    if shown.course.stops.is_empty() || size.rows == 0 {
        return;
    }
    let scale = Scale::of(shown, size);
    let mut canvas = Canvas::new(size, panel.look.symbols);
    let role = shown.role;
    draw_ground(shown, &scale, &mut canvas);
    draw_course(shown, &scale, Stroke::solid(role), &mut canvas);
    canvas.draw(curve, buffer);
    draw_axis(&scale, inner, buffer);
    draw_numbers(shown, &scale, curve, buffer);
}

/// The name of the plan, its length and time and, as far as there is room, the speed and the hash of its content.
fn title(shown: &Shown<'_>, draft: &Draft, panel: Panel<'_>) -> String {
    let course = &shown.course;
    let (name, way) = (draft.short_name(), length(course.length_m.round()));
    let time = seconds(course.time_s);
    let speed = figure(shown.pace.speed_m_s, 1);
    let speed = speed.trim_end_matches(".0");
    let long = text!(
        "plans-heights",
        name = name,
        length = &way,
        time = &time,
        speed = speed
    );
    let mut long = panel.text(&long);
    if course.repeats {
        long.push_str(&panel.say("plans-repeats"));
    }
    let mark = ContentHash::of(&shown.document.plan).to_string();
    let marked = panel.text(&text!("plans-mark", mark = mark));
    let middle = text!(
        "plans-heights-at",
        name = name,
        length = &way,
        time = &time,
        speed = speed
    );
    let short = text!(
        "plans-heights-short",
        name = name,
        length = way,
        time = time
    );
    let whole = format!("{long}  {marked}");
    let mut titles = [whole, long, panel.text(&middle)].into_iter();
    let room = panel.width().saturating_sub(TITLE_ENDS);
    let fitting = titles.find(|title| width(title) <= room);
    fitting.unwrap_or_else(|| panel.text(&short))
}

/// Draws the ground where it is known, otherwise the height of home.
fn draw_ground(shown: &Shown<'_>, scale: &Scale, canvas: &mut Canvas) {
    let home = Stroke::sparse(Role::Muted);
    canvas.line(scale.dot(0.0, 0.0), scale.dot(scale.length_m, 0.0), home);
    if shown.room.ground().is_empty() {
        return;
    }
    let mut before: Option<Dot> = None;
    for along_m in scale.columns() {
        let here = ground_m(shown, along_m).map(|height_m| scale.dot(along_m, height_m));
        if let (Some(from), Some(to)) = (before, here) {
            canvas.line(from, to, Stroke::solid(Role::Muted));
        }
        before = here;
    }
}

fn draw_course(shown: &Shown<'_>, scale: &Scale, stroke: Stroke, canvas: &mut Canvas) {
    let mut at = scale.dot(0.0, 0.0);
    let mut before: Option<&Stop> = None;
    for stop in &shown.course.stops {
        let next = scale.dot(stop.along_m, stop.height_m);
        if let Some(before) = before.filter(|before| follows_ground(shown, before, stop)) {
            draw_over_ground(shown, scale, [before, stop], canvas);
        } else {
            let is_over_terrain = is_over_terrain(shown, stop);
            let stroke = if is_over_terrain {
                Stroke::dense(stroke.role)
            } else {
                stroke
            };
            canvas.line(at, next, stroke);
        }
        at = scale.dot(stop.left_m(), stop.height_m);
        canvas.line(next, at, stroke);
        if stop.lands {
            let ground = scale.dot(stop.along_m, 0.0);
            canvas.line(at, ground, stroke);
            at = ground;
        }
        before = Some(stop);
    }
}

fn is_over_terrain(shown: &Shown<'_>, stop: &Stop) -> bool {
    let item = shown.document.plan.get(stop.item);
    item.and_then(PlanFrame::of) == Some(PlanFrame::Terrain)
}

fn follows_ground(shown: &Shown<'_>, from: &Stop, to: &Stop) -> bool {
    !shown.room.ground().is_empty()
        && is_over_terrain(shown, from)
        && is_over_terrain(shown, to)
        && to.leg_m >= 1.0
}

/// Draws a leg at heights above the ground.
fn draw_over_ground(shown: &Shown<'_>, scale: &Scale, [from, to]: [&Stop; 2], canvas: &mut Canvas) {
    let role = shown.role;
    let above = |stop: &Stop| stop.height_m - ground_m(shown, stop.along_m).unwrap_or(0.0);
    let (start_m, end_m) = (above(from), above(to));
    let mut at = scale.dot(from.left_m(), from.height_m);
    let own = |along_m: &f64| (from.left_m()..=to.along_m).contains(along_m);
    for along_m in scale.columns().filter(own) {
        let share = (along_m - from.left_m()) / to.leg_m;
        let height_m = start_m + (end_m - start_m) * share;
        let next = scale.dot(along_m, height_m + ground_m(shown, along_m).unwrap_or(0.0));
        canvas.line(at, next, Stroke::dense(role));
        at = next;
    }
    canvas.line(at, scale.dot(to.along_m, to.height_m), Stroke::dense(role));
}

fn draw_axis(scale: &Scale, panel: Panel<'_>, buffer: &mut Buffer) {
    let last = panel.area.height.saturating_sub(1);
    for (row, height_m) in [(0, scale.high_m), (last, scale.low_m)] {
        let label = format!("{} m", figure(height_m, 0));
        let label = aligned(&label, usize::from(AXIS) - 1, true);
        let line = Line::styled(label, panel.style(Role::Muted));
        put(buffer, row_of(panel.area, row), 0, &line);
    }
}

/// Draws the numbers of the items above the curve, as far as there is room; the number under the
/// cursor is always drawn.
fn draw_numbers(shown: &Shown<'_>, scale: &Scale, panel: Panel<'_>, buffer: &mut Buffer) {
    let is_plan = shown.room.list() == ListKind::Plan;
    let cursor = shown.room.row().filter(|_| is_plan);
    let mut taken: Vec<(u16, u16)> = Vec::new();
    let (chosen, others): (Vec<&Stop>, Vec<&Stop>) = shown
        .course
        .stops
        .iter()
        .partition(|stop| Some(stop.item) == cursor);
    for stop in chosen.into_iter().chain(others) {
        let text = (stop.item + 1).to_string();
        let width = text.len() as u16;
        let dot = scale.dot(stop.along_m, stop.height_m);
        let column = (dot.x / f64::from(DOTS_ACROSS)) as u16;
        let column = column.min(panel.area.width.saturating_sub(width));
        let row = (dot.y / f64::from(DOTS_DOWN)) as u16;
        let row = row.saturating_sub(1);
        let is_free = taken
            .iter()
            .all(|(from, to)| column > *to || column + width < *from);
        if !is_free {
            continue;
        }
        taken.push((column, column + width));
        let role = if Some(stop.item) == cursor {
            Role::Selected
        } else {
            Role::Text
        };
        let place = panel.at(row_of(panel.area, row)).columns(column, width);
        stamp(&text, panel.style(role), place, buffer);
    }
}
