//! The quality of the position: GPS, navigation filter and vibration, compared with their limits.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::VehicleSubject;
use super::row::{UNKNOWN, bar, filled, grade_word, labelled, number};
use crate::text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::put;
use crate::vehicle::{EkfFlags, Grade};

/// The width of a value before a word, in columns.
const VALUE: usize = 19;
/// The widths of a number before its bar, and of the bar, in columns.
const NUMBER: usize = 6;
const BAR: usize = VALUE - NUMBER - 1;
/// The value of a full bar: 25 % above the limit.
const FULL_VARIANCE: f32 = 1.0;
const FULL_VIBRATION: f32 = 75.0;

/// Draws the readings with their grades.
pub(super) fn draw(subject: &VehicleSubject<'_>, area: Rect, buffer: &mut Buffer) {
    let look = subject.look;
    let inner = Panel::new(look, area).titled(&look.say("vehicle-estimate"), buffer);
    let rows = gps(subject)
        .into_iter()
        .chain(filter(subject))
        .chain(vibration(subject));
    for (at, line) in rows.enumerate() {
        put(buffer, inner, at as u16, &line);
    }
}

fn graded(
    subject: &VehicleSubject<'_>,
    label: &str,
    value: &str,
    grade: Option<Grade>,
) -> Line<'static> {
    let mut spans = vec![Span::raw(format!("{} ", filled(value, VALUE)))];
    let is_old = subject.vehicle.link.lost;
    spans.extend(grade.map(|grade| grade_word(subject.look, grade, is_old)));
    labelled(subject.look, label, spans)
}

fn gps(subject: &VehicleSubject<'_>) -> [Line<'static>; 2] {
    let (vehicle, look) = (subject.vehicle, subject.look);
    let fix = vehicle.gps.map_or(UNKNOWN.to_owned(), |gps| {
        let satellites = gps
            .satellites
            .map_or(UNKNOWN.to_owned(), |count| count.to_string());
        // Without a fix there is no precision to speak of.
        look.text(&if Grade::of_fix(gps.fix) == Grade::Good {
            text!(
                "vehicle-gps",
                fix = gps.fix.text(),
                satellites = satellites,
                hdop = number(gps.hdop, 1)
            )
        } else {
            text!(
                "vehicle-gps-unfixed",
                fix = gps.fix.text(),
                satellites = satellites
            )
        })
    });
    let accuracy = vehicle.gps_accuracy;
    let error = accuracy.map_or(UNKNOWN.to_owned(), |accuracy| {
        let [horizontal, vertical] =
            [accuracy.horizontal_m, accuracy.vertical_m].map(|error| number(Some(error), 1));
        format!("±{horizontal} m  ↕ {vertical} m")
    });
    [
        graded(
            subject,
            "GPS",
            &fix,
            vehicle.gps.as_ref().map(Grade::of_gps),
        ),
        graded(
            subject,
            &look.say("vehicle-gps-error"),
            &error,
            accuracy.as_ref().map(Grade::of_accuracy),
        ),
    ]
}

fn filter(subject: &VehicleSubject<'_>) -> Vec<Line<'static>> {
    let (vehicle, look) = (subject.vehicle, subject.look);
    let ekf = vehicle.ekf;
    let position = EkfFlags::POSITION_HORIZONTAL_ABSOLUTE;
    let word = match ekf.map(|ekf| ekf.flags.has(position)) {
        Some(true) => look.say("vehicle-ekf-position"),
        Some(false) => look.say("vehicle-ekf-lost"),
        None => UNKNOWN.to_owned(),
    };
    let grade = ekf.as_ref().map(Grade::of_ekf);
    let mut lines = vec![graded(subject, "EKF", &word, grade)];
    let ratios = [
        ("vehicle-ekf-velocity", ekf.map(|ekf| ekf.velocity_variance)),
        (
            "vehicle-ekf-horizontal",
            ekf.map(|ekf| ekf.position_horizontal_variance),
        ),
        (
            "vehicle-ekf-vertical",
            ekf.map(|ekf| ekf.position_vertical_variance),
        ),
        ("vehicle-ekf-compass", ekf.map(|ekf| ekf.compass_variance)),
    ];
    for (id, ratio) in ratios {
        let value = measured(ratio, 2, FULL_VARIANCE, look);
        lines.push(graded(
            subject,
            &look.say(id),
            &value,
            ratio.map(Grade::of_variance),
        ));
    }
    lines
}

fn vibration(subject: &VehicleSubject<'_>) -> Vec<Line<'static>> {
    let (vehicle, look) = (subject.vehicle, subject.look);
    let vibration = vehicle.vibration;
    let axes = ["x", "y", "z"].into_iter().enumerate();
    let mut lines: Vec<Line<'static>> = axes
        .map(|(axis, name)| {
            let level = vibration.map(|vibration| vibration.level_m_s2[axis]);
            let value = measured(level, 1, FULL_VIBRATION, look);
            let label = look.text(&text!("vehicle-vibration", axis = name));
            graded(subject, &label, &value, level.map(Grade::of_vibration))
        })
        .collect();
    let counts = vibration.and_then(|vibration| vibration.clipping);
    let value = counts.map_or(UNKNOWN.to_owned(), |[x, y, z]| format!("{x} {y} {z}"));
    let worst = counts.and_then(|counts| counts.into_iter().max());
    lines.push(graded(
        subject,
        &look.say("vehicle-clipping"),
        &value,
        worst.map(Grade::of_clipping),
    ));
    let style = look.style(Role::Muted);
    lines.push(Line::styled(look.say("vehicle-limits"), style));
    lines
}

/// A number with a bar.
fn measured(value: Option<f32>, decimals: usize, full: f32, look: &Look) -> String {
    let shown = number(value, decimals);
    let bar = value.map_or(String::new(), |value| bar(value / full, BAR, look.symbols));
    format!("{shown:>NUMBER$} {bar}")
}
