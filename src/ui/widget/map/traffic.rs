//! Other aircraft on the map: their sign with the course, callsign, height above the vehicle that they come closest to,
//! and the age of an old report; and where they will be in half a minute.

use std::time::Duration;

use super::canvas::{Canvas, Stroke};
use super::labels::{Label, LabelKind};
use super::markers::arrow;
use crate::app::State;
use crate::app::state::TrackedAircraft;
use crate::config::Symbols;
use crate::geo::Viewport;
use crate::ui::look::Look;
use crate::ui::widget::traffic::threat_role;

/// The letter before the course of an aircraft. Vehicles have arrows without a letter.
const SIGN: char = 'A';
/// How far ahead the course is drawn, in seconds.
const AHEAD_S: f64 = 30.0;
/// The age from which the age of a report is shown.
const OLD: Duration = Duration::from_secs(3);

/// The sign in the legend.
pub fn sample(symbols: Symbols) -> String {
    format!("{SIGN}{}", arrow(45.0, symbols))
}

/// Draws the courses of all aircraft in view, and adds their labels.
pub fn draw(
    state: &State,
    look: &Look,
    view: &Viewport,
    canvas: &mut Canvas,
    labels: &mut Vec<Label>,
) {
    // The most urgent one takes precedence if there is no room for all.
    for tracked in state.session().traffic().tracked().iter().rev() {
        let role = threat_role(tracked.threat());
        let aircraft = &tracked.aircraft;
        let age = aircraft.age(state.now());
        let now = aircraft.place_in(age.as_secs_f64());
        let then = aircraft.place_in(age.as_secs_f64() + AHEAD_S);
        if let Some(cell) = view.cell(now) {
            canvas.line(view.dot(now), view.dot(then), Stroke::dotted(role));
            labels.push(Label {
                cell,
                kind: LabelKind::Signed,
                text: text(tracked, age, look.symbols),
                role,
            });
        }
    }
}

fn text(tracked: &TrackedAircraft, age: Duration, symbols: Symbols) -> String {
    let course = tracked.aircraft.course_deg();
    let course = course.map(|it| arrow(it as f32, symbols).to_string());
    let height = tracked
        .worst()
        .map(|worst| format!(" {:+.0} m", worst.approach.height_m));
    let age = (age >= OLD).then(|| format!(" {} s", age.as_secs()));
    format!(
        "{SIGN}{}{}{}{}",
        course.unwrap_or_default(),
        tracked.aircraft.name(),
        height.unwrap_or_default(),
        age.unwrap_or_default()
    )
}
