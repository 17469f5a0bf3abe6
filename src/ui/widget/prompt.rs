//! The prompts for a line.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::text::{Line, Span};

use super::palette::draw_line;
use crate::app::State;
use crate::app::action::Action;
use crate::app::keymap::Place;
use crate::app::room::parameters;
use crate::app::state::{Prompt, Purpose};
use crate::text;
use crate::text::Text;
use crate::ui::look::Look;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{below, centred, put, wrap};
use crate::vehicle_id::ranges;

const EXAMPLES: &[(&str, &str)] = &[
    ("tcp:127.0.0.1:5760", "prompt-connect-tcp"),
    ("udpin:0.0.0.0:14550", "prompt-connect-udpin"),
    ("udp:192.168.1.20:14550", "prompt-connect-udp"),
    ("serial:/dev/ttyACM0:115200", "prompt-connect-serial"),
    ("file:FLIGHT.tlog", "prompt-connect-file"),
];
const HEIGHT: u16 = 14;
const WIDTH: u16 = 72;
/// The number of rows of a fault that fit into `HEIGHT`.
const FAULT_ROWS: usize = 3;
/// The height of a prompt at the bottom, in rows: a frame, the line, and two lines for a fault.
const BOTTOM_HEIGHT: u16 = 5;

/// Draws the prompt and returns the position of the terminal's cursor.
pub fn draw(state: &State, prompt: &Prompt, panel: Panel<'_>, buffer: &mut Buffer) -> Position {
    let asks_for_addresses = matches!(prompt.purpose(), Purpose::Connect);
    let place = if asks_for_addresses {
        centred(WIDTH, HEIGHT + long_fault(prompt, panel.look), panel.area)
    } else {
        // The subject of the line stays visible.
        at_the_bottom(panel.area)
    };
    let inner = panel
        .at(place)
        .boxed(&title(prompt.purpose(), panel.look), Role::Accent, buffer);
    let (cursor, _) = draw_line(prompt.input(), None, panel.at(inner), buffer);
    let mut row = 1;
    let fault = prompt.fault().map(|fault| panel.text(fault));
    for line in wrap(&fault.unwrap_or_default(), usize::from(inner.width)) {
        put(
            buffer,
            inner,
            row,
            &Line::styled(line, panel.style(Role::Danger)),
        );
        row += 1;
    }
    if asks_for_addresses {
        draw_examples(state, panel.at(below(inner, row + 1)), buffer);
    } else if prompt.fault().is_none() {
        let doubt = doubt(state, prompt);
        let role = if doubt.is_some() {
            Role::Warning
        } else {
            Role::Muted
        };
        let said = doubt.unwrap_or_else(|| advice(state, prompt.purpose()));
        let text = panel.text(&said);
        for (row, line) in (1..).zip(wrap(&text, usize::from(inner.width))) {
            put(buffer, inner, row, &Line::styled(line, panel.style(role)));
        }
    }
    cursor
}

/// The warning that the value typed so far contradicts the parameter's documentation.
fn doubt(state: &State, prompt: &Prompt) -> Option<Text> {
    let Purpose::Parameter { name, vehicles } = prompt.purpose() else {
        return None;
    };
    let value: f64 = prompt.input().value().trim().parse().ok()?;
    let doubt = parameters::doubt(state, vehicles, name, value)?;
    Some(text!(
        "documentation-still",
        doubt = doubt,
        submit = submit(state)
    ))
}

/// The number of extra rows that a fault needs.
fn long_fault(prompt: &Prompt, look: &Look) -> u16 {
    let fault = prompt.fault().map(|fault| look.text(fault));
    let lines = wrap(&fault.unwrap_or_default(), usize::from(WIDTH) - 4).len();
    lines.saturating_sub(FAULT_ROWS) as u16
}

fn title(purpose: &Purpose, look: &Look) -> String {
    match purpose {
        Purpose::Connect => look.say("prompt-connect"),
        Purpose::NewProfile => look.say("prompt-profile"),
        Purpose::Seed(_) => look.say("prompt-seed"),
        Purpose::Filter(_) => look.say("prompt-filter"),
        Purpose::Parameter { name, vehicles } => look.text(&text!(
            "prompt-parameter",
            name = name,
            vehicles = ranges(vehicles.iter().copied())
        )),
        Purpose::PutFile { vehicle, folder } => look.text(&text!(
            "prompt-put-file",
            folder = folder,
            vehicle = *vehicle
        )),
        Purpose::SaveParameters => look.say("prompt-save-parameters"),
        Purpose::LoadParameters => look.say("prompt-load-parameters"),
        Purpose::CompareParameters => look.say("prompt-compare-parameters"),
        Purpose::SaveDesign => look.say("prompt-save-design"),
        Purpose::CopyDesign(of) => look.text(&text!("prompt-copy-design", name = of)),
        Purpose::RenameDesign(old) => look.text(&text!("prompt-rename-design", name = old)),
        Purpose::ExportDesign => look.say("prompt-export-design"),
        Purpose::ImportDesign => look.say("prompt-import-design"),
    }
}

fn advice(state: &State, purpose: &Purpose) -> Text {
    match purpose {
        Purpose::Connect => Text::default(),
        Purpose::NewProfile => text!("prompt-profile-advice"),
        Purpose::Seed(_) => text!("prompt-seed-advice", submit = submit(state)),
        Purpose::Filter(_) => text!(
            "prompt-filter-advice",
            submit = submit(state),
            escape = escape(state)
        ),
        Purpose::Parameter { .. } => text!(
            "prompt-parameter-advice",
            submit = submit(state),
            escape = escape(state)
        ),
        Purpose::PutFile { .. } => text!("prompt-put-file-advice"),
        Purpose::SaveParameters | Purpose::ExportDesign => text!("prompt-save-advice"),
        Purpose::LoadParameters => text!("prompt-load-advice"),
        Purpose::CompareParameters => text!("prompt-compare-advice"),
        Purpose::SaveDesign | Purpose::CopyDesign(_) | Purpose::RenameDesign(_) => {
            text!("prompt-design-advice")
        }
        Purpose::ImportDesign => text!("prompt-import-advice"),
    }
}

fn submit(state: &State) -> Text {
    state.keymap().key(Action::Submit, Place::Prompt)
}

fn escape(state: &State) -> Text {
    state.keymap().key(Action::Escape, Place::Prompt)
}

/// A box over the last lines of the room.
fn at_the_bottom(area: Rect) -> Rect {
    let height = BOTTOM_HEIGHT.min(area.height.saturating_sub(1));
    Rect {
        y: area.bottom().saturating_sub(height + 1),
        height,
        ..area
    }
}

fn draw_examples(state: &State, panel: Panel<'_>, buffer: &mut Buffer) {
    for (row, (address, meaning)) in EXAMPLES.iter().enumerate() {
        let line = Line::from(vec![
            Span::raw(format!("{address:28}")),
            Span::styled(panel.say(meaning), panel.style(Role::Muted)),
        ]);
        put(buffer, panel.area, row as u16, &line);
    }
    let text = panel.text(&text!(
        "prompt-connect-several",
        submit = submit(state),
        escape = escape(state)
    ));
    let row = EXAMPLES.len() as u16 + 1;
    put(
        buffer,
        panel.area,
        row,
        &Line::styled(text, panel.style(Role::Muted)),
    );
}
