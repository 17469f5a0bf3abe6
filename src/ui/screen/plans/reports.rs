//! The reports, as far as there is room: faults, the last trial, the last command to vehicles, and the next step.

use std::cmp::Reverse;

use ratatui::buffer::Buffer;
use ratatui::text::Line;

use super::Shown;
use crate::app::State;
use crate::app::action::{Action, PlansAction};
use crate::app::room::plans::next_step;
use crate::ledger::{EntryId, LedgerEntry, RowState};
use crate::plan::check::{Finding, Severity};
use crate::preflight::shared_finding_words;
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::{clip, ledger, put, wrap};
use crate::verb::Verb;

/// The number of columns before a text, and before the lines that continue it.
const INDENT: usize = 1;
const FURTHER: usize = 3;

/// The number of rows in which each report has one line; with fewer, the absence of faults is not
/// mentioned beside a command.
const ALL_REPORTS: usize = 4;

#[derive(Default)]
struct Report {
    lines: Vec<Line<'static>>,
}

impl Report {
    /// Adds a text in as many lines as it needs.
    fn say(&mut self, text: &str, role: Role, panel: Panel<'_>) {
        let width = panel.width().saturating_sub(FURTHER);
        for (row, line) in wrap(text, width).into_iter().enumerate() {
            let indent = if row == 0 { INDENT } else { FURTHER };
            let line = format!("{:indent$}{line}", "");
            self.lines.push(Line::styled(line, panel.style(role)));
        }
    }

    /// The first lines of the report; a mark shows that there are more.
    fn cut(mut self, rows: usize, width: usize) -> Vec<Line<'static>> {
        if self.lines.len() > rows {
            self.lines.truncate(rows);
            if let Some(last) = self.lines.last_mut() {
                let style = last.style;
                let text = format!("{last} ");
                let room = width.min(text.chars().count());
                *last = Line::styled(clip(&format!("{text} "), room), style);
            }
        }
        self.lines
    }
}

/// Draws the reports; faults, the trial and the last command have at least one line each.
pub(super) fn draw(
    state: &State,
    shown: Option<&Shown<'_>>,
    panel: Panel<'_>,
    buffer: &mut Buffer,
) {
    let tried = shown
        .map(|shown| tried(state, shown, panel))
        .unwrap_or_default();
    let next = shown
        .map(|shown| next(state, shown, panel))
        .unwrap_or_default();
    let entry = last_entry(state);
    let is_short = usize::from(panel.area.height) < ALL_REPORTS && entry.is_some();
    let found = shown
        .map(|shown| found(shown, is_short, panel))
        .unwrap_or_default();
    let command = |rows| {
        let entry = entry.as_ref()?;
        Some(command(state, entry, rows, panel))
    };
    let whole = command(usize::MAX).map_or(0, |lines| lines.len());
    let needs = ReportRows {
        found: found.lines.len(),
        tried: tried.lines.len(),
        command: whole,
        next: next.lines.len(),
    };
    let rows = needs.within(usize::from(panel.area.height));
    let width = panel.width();
    let lines = found.cut(rows.found, width).into_iter();
    let lines = lines.chain(tried.cut(rows.tried, width));
    let lines = lines.chain(command(rows.command).into_iter().flatten());
    for (row, line) in (0..).zip(lines.chain(next.cut(rows.next, width))) {
        put(buffer, panel.area, row, &line);
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct ReportRows {
    found: usize,
    tried: usize,
    command: usize,
    next: usize,
}

impl ReportRows {
    /// The rows that fit: first one line of each report, then further lines; without a command, the
    /// next step is left out first.
    fn within(self, rows: usize) -> Self {
        let mut left = rows;
        let mut take = |needed: usize| {
            let taken = needed.min(left);
            left -= taken;
            taken
        };
        let mut given = Self {
            found: take(self.found.min(1)),
            tried: take(self.tried.min(1)),
            command: take(self.command.min(1)),
            // After a command, the next step matters more than further lines.
            next: take(self.next.min(self.command).min(1)),
        };
        given.tried += take(self.tried - given.tried);
        given.found += take(self.found - given.found);
        given.next += take(self.next.min(1) - given.next);
        given.command += take(self.command - given.command);
        given.next += take(self.next - given.next);
        given
    }
}

/// The faults: those of the item under the cursor first, then the most serious.
fn found(shown: &Shown<'_>, is_short: bool, panel: Panel<'_>) -> Report {
    let mut report = Report::default();
    let findings = &shown.findings;
    if findings.is_empty() {
        let is_empty = shown.document.kinds().next().is_none();
        if is_empty {
            report.say(&panel.say("plans-begin"), Role::Muted, panel);
        } else if shown.room.tried().is_none() && !is_short {
            report.say(&panel.say("plans-no-faults"), Role::Ok, panel);
        }
        return report;
    }
    let row = shown.room.row();
    let is_own = |it: &Finding| it.list == shown.room.list() && it.item.is_some() && it.item == row;
    let mut faults = shared(findings);
    faults.sort_by_key(|fault| {
        let mut same = findings.iter().filter(|it| is_same(it, fault.first));
        Reverse((same.any(&is_own), fault.first.severity()))
    });
    let count = panel.text(&text!("plans-faults", count = faults.len()));
    for (at, fault) in faults.into_iter().enumerate() {
        let (mark, role) = match fault.first.severity() {
            Severity::Error => ("!", Role::Danger),
            Severity::Warning => ("?", Role::Warning),
        };
        let words = panel.text(&shared_finding_words(fault.first, &fault.items));
        let text = if at == 0 {
            format!("{mark} {count}: {words}")
        } else {
            format!("{mark} {words}")
        };
        report.say(&text, role, panel);
    }
    report
}

fn is_same(a: &Finding, b: &Finding) -> bool {
    a.list == b.list && a.kind == b.kind
}

struct SharedFault<'a> {
    first: &'a Finding,
    items: Vec<usize>,
}

/// The findings; one that several items share appears once.
fn shared(findings: &[Finding]) -> Vec<SharedFault<'_>> {
    let mut faults: Vec<SharedFault<'_>> = Vec::new();
    for finding in findings {
        match faults.iter_mut().find(|it| is_same(it.first, finding)) {
            Some(known) => known.items.extend(finding.item),
            None => faults.push(SharedFault {
                first: finding,
                items: finding.item.into_iter().collect(),
            }),
        }
    }
    faults
}

fn tried(state: &State, shown: &Shown<'_>, panel: Panel<'_>) -> Report {
    let mut report = Report::default();
    if let Some(tried) = shown.room.tried() {
        let role = if tried.is_sound {
            Role::Ok
        } else {
            Role::Warning
        };
        // The figures name each pair in conflict.
        let has_figures = shown.room.flight().is_some();
        let details = tried.details.iter().filter(|_| !has_figures);
        let key = state.key(Action::Plans(PlansAction::ShowFigures));
        let are_hidden = has_figures && shown.room.figures().is_none();
        let is_counted = tried.further > 0 && are_hidden;
        let text = if is_counted {
            text!("plans-tried-further", text = tried.outcome(), key = &key)
        } else {
            tried.outcome()
        };
        for text in std::iter::once(&text).chain(details) {
            report.say(&panel.text(text), role, panel);
        }
        if let Some(left_out) = &tried.left_out {
            report.say(&panel.text(left_out), Role::Warning, panel);
        }
        if has_figures && !is_counted {
            let key = text!("plans-figures-key", key = key);
            report.say(&panel.text(&key), Role::Muted, panel);
        }
    }
    report
}

/// The last command to vehicles; the commands of one upload count as one.
enum LastEntry<'a> {
    One(&'a LedgerEntry),
    Upload(Vec<&'a LedgerEntry>),
}

/// Whether a verb is about the lists that this room shows.
fn is_of_lists(verb: &Verb) -> bool {
    let list = verb.name.split(' ').next();
    list.is_some_and(|list| ["plan", "fence", "rally"].contains(&list))
}

fn last_entry(state: &State) -> Option<LastEntry<'_>> {
    let ledger = state.session().ledger();
    let last = ledger.entries().rfind(|it| is_of_lists(it.verb))?;
    let uploads = state.rooms().plans().uploads();
    let entry = |id: &EntryId| ledger.entry(*id);
    Some(if uploads.len() > 1 && uploads.contains(&last.id) {
        LastEntry::Upload(uploads.iter().filter_map(entry).collect())
    } else {
        LastEntry::One(last)
    })
}

fn command(
    state: &State,
    last: &LastEntry<'_>,
    rows: usize,
    panel: Panel<'_>,
) -> Vec<Line<'static>> {
    let width = panel.width().saturating_sub(INDENT);
    let of = |entry, rows| {
        let lines = ledger::lines_within(entry, state.session(), width, rows, panel.look);
        let indented = lines.into_iter().map(|mut line| {
            line.spans.insert(0, " ".repeat(INDENT).into());
            line
        });
        indented.collect::<Vec<Line<'static>>>()
    };
    match last {
        LastEntry::One(entry) => of(*entry, rows),
        LastEntry::Upload(entries) => {
            let (text, role) = upload(entries);
            let mut report = Report::default();
            report.say(&panel.text(&text), role, panel);
            let failed =
                |entry: &&&LedgerEntry| entry.rows.iter().any(|row| row.state.is_failure());
            if let Some(failed) = entries.iter().find(failed) {
                let left = rows.saturating_sub(report.lines.len());
                report.lines.extend(of(failed, left));
            }
            report.lines
        }
    }
}

/// The state of an upload of several lists.
fn upload(entries: &[&LedgerEntry]) -> (Text, Role) {
    let rows: Vec<RowState> = entries
        .iter()
        .flat_map(|entry| entry.rows.iter().map(|row| row.state))
        .collect();
    let failed = rows.iter().filter(|row| row.is_failure()).count();
    let done = rows.iter().filter(|row| row.is_final()).count() - failed;
    let count = rows.len();
    if failed > 0 {
        let text = text!("plans-upload-failed", failed = failed, count = count);
        (text, Role::Danger)
    } else if done == count {
        (text!("plans-upload-done", count = count), Role::Ok)
    } else {
        let text = text!("plans-upload", done = done, count = count);
        (text, Role::Info)
    }
}

fn next(state: &State, shown: &Shown<'_>, panel: Panel<'_>) -> Report {
    let mut report = Report::default();
    if let Some(step) = next_step(state, &shown.findings) {
        report.say(&panel.text(&step.text(state)), Role::Muted, panel);
    }
    report
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::ListKind;
    use crate::plan::check::FindingKind;

    #[test]
    fn a_fault_of_several_items_is_counted_once() {
        let finding = |item, kind| Finding {
            list: ListKind::Plan,
            item: Some(item),
            kind,
        };
        let findings = [
            finding(4, FindingKind::NoTerrain),
            finding(6, FindingKind::NoTerrain),
            finding(6, FindingKind::NoEnd),
        ];
        let faults = shared(&findings);
        assert_eq!(faults.len(), 2);
        let words = shared_finding_words(faults[0].first, &faults[0].items).to_string();
        assert!(words.starts_with("plan, items 5, 7: "), "{words}");
    }

    fn within(needs: [usize; 4], rows: usize) -> [usize; 4] {
        let [found, tried, command, next] = needs;
        let needs = ReportRows {
            found,
            tried,
            command,
            next,
        };
        let rows = needs.within(rows);
        [rows.found, rows.tried, rows.command, rows.next]
    }

    #[test]
    fn each_report_has_a_line_before_any_has_two_and_the_next_step_comes_last() {
        assert_eq!(within([1, 0, 1, 1], 3), [1, 0, 1, 1]);
        assert_eq!(within([1, 2, 3, 1], 3), [1, 1, 1, 0]);
        assert_eq!(within([0, 2, 1, 1], 3), [0, 1, 1, 1]);
        assert_eq!(within([0, 2, 3, 1], 7), [0, 2, 3, 1]);
        assert_eq!(within([9, 2, 1, 1], 7), [3, 2, 1, 1]);
        assert_eq!(within([1, 1, 1, 1], 0), [0; 4]);
    }
}
