//! What is documented about the parameter under the cursor.

use ratatui::text::{Line, Span};

use crate::parameters::{ListedParameter, ParameterDocument};
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::wrap;

/// The documentation in lines: title and limits, the values or bits, the description. At most `rows` lines; the
/// last one shows that more follows.
pub fn lines(
    document: &ParameterDocument,
    now: Option<&ListedParameter>,
    rows: usize,
    panel: Panel<'_>,
) -> Vec<Line<'static>> {
    let width = panel.width().saturating_sub(2);
    let mut lines = vec![Line::from(heading(document, now, panel))];
    for text in listings(document) {
        let wrapped = wrap(&panel.text(&text), width).into_iter();
        let style = panel.style(Role::Text);
        lines.extend(wrapped.map(|line| Line::styled(format!(" {line}"), style)));
    }
    let description = wrap(&document.description, width).into_iter();
    let style = panel.style(Role::Muted);
    lines.extend(description.map(|line| Line::styled(format!(" {line}"), style)));
    if lines.len() > rows {
        lines.truncate(rows);
        if let Some(last) = lines.last_mut() {
            last.push_span(Span::styled(" ..", style));
        }
    }
    lines
}

/// The title, the type, the range with its unit, the step, and whether a reboot is needed.
fn heading(
    document: &ParameterDocument,
    now: Option<&ListedParameter>,
    panel: Panel<'_>,
) -> Vec<Span<'static>> {
    let mut facts: Vec<Text> = Vec::new();
    facts.extend(now.map(|now| Text::verbatim(now.kind.name())));
    facts.extend(document.range.map(|range| match document.unit.as_str() {
        "" => range.text(),
        unit => Text::joined(" ", vec![range.text(), Text::verbatim(unit)]),
    }));
    if document.range.is_none() && !document.unit.is_empty() {
        facts.push(Text::verbatim(document.unit.as_str()));
    }
    facts.extend(
        document
            .increment
            .map(|step| text!("documentation-step", step = step.to_string())),
    );
    let facts = panel.text(&Text::joined(", ", facts));
    let mut spans = vec![
        Span::styled(format!(" {}", document.title), panel.style(Role::Title)),
        Span::styled(format!("  {facts}"), panel.style(Role::Text)),
    ];
    if document.needs_reboot {
        let reboot = panel.say("documentation-reboot");
        spans.push(Span::styled(
            format!("  {reboot}"),
            panel.style(Role::Warning),
        ));
    }
    spans
}

/// The documented values and bits.
fn listings(document: &ParameterDocument) -> Vec<Text> {
    let values = document.values.iter();
    let values: Vec<String> = values
        .map(|it| format!("{} {}", it.value, it.name))
        .collect();
    let bits = document.bits.iter();
    let bits: Vec<String> = bits.map(|it| format!("{} {}", it.bit, it.name)).collect();
    let mut texts = Vec::new();
    if !values.is_empty() {
        texts.push(text!("documentation-values", values = values.join(", ")));
    }
    if !bits.is_empty() {
        texts.push(text!("documentation-bits", bits = bits.join(", ")));
    }
    texts
}
