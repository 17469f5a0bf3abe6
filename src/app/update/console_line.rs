//! Commands to the console itself.

use std::sync::Arc;

use super::show::{brief, look_back, show};
use super::{
    alert_line, class, crew, drafts, ending, forget, forwards, ghost, links, macros, mission, pace,
    radio, replay, review, selection,
};
use crate::app::State;
use crate::app::effect::{CareerEffect, Effect, Effects, SessionEffect, TerminalEffect};
use crate::app::room::{Room, fly, hangar, parameters};
use crate::app::state::{HelpPage, Log, Overlay};
use crate::config::{LiveSetting, Symbols};
use crate::diagnostic::Diagnostic;
use crate::language::{self, ConsoleLine, ParametersLine, Report, TableLine, Targets, words};
use crate::operator::first_word;
use crate::plan::ListKind;
use crate::text;
use crate::text::Text;
use crate::vehicle::{CarriedLists, Severity, VehicleId};
use crate::vehicle_id::ranges;

/// Carries out a command.
///
/// # Errors
/// The reason why the command is not possible, with the position of the faulty word.
pub fn carry_out(state: &mut State, line: &str, own: ConsoleLine) -> Result<Effects, Diagnostic> {
    let last_word = words(line).pop().map_or(0..0, |word| word.span);
    if let Some(reason) = state.line_refusal(&own) {
        return Err(Diagnostic::new(first_word(line), reason));
    }
    if let ConsoleLine::Macro(name) = &own {
        macros::check(state, name, last_word)?;
        let lines = state.config.macros.get(name).cloned().unwrap_or_default();
        for line in lines.into_iter().rev() {
            state.typing.macro_lines.push_front(line);
        }
        return Ok(Effects::none());
    }
    if let ConsoleLine::Draft(draft_line) = own {
        return drafts::carry_out(state, draft_line).map_err(|refusal| {
            let faulty = state.with_context(|it| language::draft_part(line, refusal.part, it));
            Diagnostic::new(faulty.unwrap_or(last_word), refusal.reason)
        });
    }
    obey(state, own).map_err(|text| Diagnostic::new(last_word, text))
}

/// Carries out a command that is not a macro.
fn obey(state: &mut State, own: ConsoleLine) -> Result<Effects, Text> {
    match own {
        ConsoleLine::Report(report) => inform(state, &report),
        ConsoleLine::Select(vehicles) => {
            let ids = state.chosen(&vehicles)?;
            selection::select(state, &ids);
        }
        ConsoleLine::Carried { kind, targets } => carried(state, kind, &targets)?,
        ConsoleLine::Group { name, vehicles } => {
            let ids = match vehicles {
                Some(vehicles) => state.chosen(&vehicles)?,
                None => state.addressed(),
            };
            group(state, name, ids)?;
        }
        ConsoleLine::Ungroup(name) => ungroup(state, &name)?,
        ConsoleLine::Forget(vehicles) => return forget::forget(state, vehicles.as_ref()),
        ConsoleLine::Forward(line) => return forwards::carry_out(state, line),
        // The grammar accepts only names of rooms.
        ConsoleLine::Show(name) => show(state, Room::named(&name).unwrap_or_default()),
        ConsoleLine::Fly(id) => return Ok(mission::start(state, state.training().launch(&id))),
        ConsoleLine::FlyFree => {
            let effect = Effect::Session(SessionEffect::StartFree);
            return Ok(ending::guarded(state, text!("ask-start"), effect));
        }
        ConsoleLine::Connect(addresses) => {
            let effect = Effect::Session(SessionEffect::Connect(addresses));
            return Ok(ending::guarded(state, text!("ask-start"), effect));
        }
        ConsoleLine::Inject(_) if state.session.is_paused() => return Err(text!("pause-refuses")),
        ConsoleLine::Inject(name) => {
            if let Some(reason) = state.holds_brief() {
                return Err(reason);
            }
            state.session.leave_brief();
            return Ok(Effects::from(Effect::Session(SessionEffect::Inject(name))));
        }
        // They were carried out above.
        ConsoleLine::Macro(_) | ConsoleLine::Draft(_) => {}
        ConsoleLine::Set(setting) => return Ok(set(state, &setting)),
        ConsoleLine::Parameters(own) => return parameters(state, own),
        ConsoleLine::Process { deed, vehicle } => return Ok(hangar::order(state, deed, vehicle)),
        ConsoleLine::Radio { choice, test } => return radio::carry_out(state, &choice, test),
        ConsoleLine::Messages(own) => return links::messages_line(state, own),
        ConsoleLine::Table(own) => arrange(state, own),
        ConsoleLine::Alerts(own) => alert_line::carry_out(state, own)?,
        ConsoleLine::Pause => return Ok(mission::pause(state)),
        ConsoleLine::Continue => return Ok(mission::go_on(state)),
        ConsoleLine::Speedup(speedup) => return Ok(pace::set(state, speedup)),
        ConsoleLine::Replay(line) => return Ok(replay::carry_out(state, line)),
        ConsoleLine::Bookmark(text) => return replay::bookmark(state, text),
        ConsoleLine::Unbookmark => return replay::unbookmark(state),
        ConsoleLine::Review(line) => return review::carry_out(state, line),
        ConsoleLine::Ghost(line) => return ghost::carry_out(state, line),
        ConsoleLine::Class(line) => return class::carry_out(state, line),
        ConsoleLine::Crew(line) => return crew::carry_out(state, line),
        ConsoleLine::Abandon => return Ok(mission::abandon(state)),
        ConsoleLine::Restart => return Ok(mission::restart(state, false)),
        ConsoleLine::Leave => return Ok(ending::leave(state)),
        ConsoleLine::Quit => return Ok(ending::quit(state)),
    }
    Ok(Effects::none())
}

/// Shows a report in its room; the plain console prints it instead.
fn inform(state: &mut State, report: &Report) {
    match report {
        Report::Help => state.overlay = Some(Overlay::Help(HelpPage::default())),
        Report::Links => show(state, Room::Links),
        Report::Ledger => show(state, Room::Ledger),
        Report::Notices => look_back(state, Log::Notices),
        Report::Traffic => look_back(state, Log::Traffic),
        Report::Hangar => show(state, Room::Hangar),
        Report::Class => show(state, Room::Class),
        Report::Brief => brief(state),
        Report::Objectives => show(state, Room::Mission),
        Report::Status(_) | Report::Contacts => show(state, Room::Fly),
    }
}

/// Shows which vehicles carry the same list.
fn carried(state: &mut State, kind: ListKind, targets: &Targets) -> Result<(), Text> {
    let selection = state.addressed();
    let ids = state.with_context(|context| targets.resolve(&selection, context))?;
    state.check_known(&ids)?;
    let vehicles = ids.iter().filter_map(|id| state.session.vehicles.get(id));
    let lists = CarriedLists::of(kind, vehicles.map(Arc::as_ref));
    let severity = if lists.are_same() {
        Severity::Notice
    } else {
        Severity::Warning
    };
    state.say(severity, lists.text());
    Ok(())
}

fn arrange(state: &mut State, line: TableLine) {
    match line {
        TableLine::Sort(sort) => fly::set_sort(state, sort),
        TableLine::Filter(text) => fly::filter(state, &text),
        TableLine::Columns(columns) => state.config.table.columns = columns,
    }
}

fn set(state: &mut State, setting: &LiveSetting) -> Effects {
    setting.apply(&mut state.config);
    match setting {
        LiveSetting::Theme(name) => {
            state.display.theme.clone_from(name);
            Effects::from(Effect::Terminal(TerminalEffect::SetTheme(name.clone())))
        }
        LiveSetting::Fps(fps) => Effects::from(Effect::Terminal(TerminalEffect::SetFps(*fps))),
        LiveSetting::Lang(language) => {
            if !state.speak(*language) {
                state.say(Severity::Warning, text!("setting-lang-ascii"));
                return Effects::none();
            }
            let is_kept = state.training.career.is_some();
            let keep = is_kept.then_some(Effect::Career(CareerEffect::SetLanguage(*language)));
            keep.into_iter().collect()
        }
        LiveSetting::Symbols(Symbols::Ascii) => {
            state.locale = Arc::default();
            Effects::none()
        }
        LiveSetting::Symbols(_) | LiveSetting::Bell(_) | LiveSetting::Notify(_) => Effects::none(),
    }
}

fn parameters(state: &mut State, line: ParametersLine) -> Result<Effects, Text> {
    match line {
        ParametersLine::Save(path) => return parameters::save(state, &path),
        ParametersLine::Compare(other) => return parameters::load(state, &other),
        ParametersLine::Fetch => parameters::fetch(state),
        ParametersLine::Show => {}
    }
    show(state, Room::Parameters);
    Ok(Effects::none())
}

fn ungroup(state: &mut State, name: &str) -> Result<(), Text> {
    if state.session.choice.groups.remove(name).is_none() {
        return Err(text!("fly-no-group", name = name));
    }
    state.say(Severity::Notice, text!("fly-ungrouped", name = name));
    Ok(())
}

fn group(state: &mut State, name: String, ids: Vec<VehicleId>) -> Result<(), Text> {
    let word = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
    if name.is_empty() || !name.chars().all(word) {
        return Err(text!("group-name", name = name));
    }
    if ids.is_empty() {
        return Err(text!("group-empty"));
    }
    let members = ranges(ids.iter().copied());
    state.say(
        Severity::Notice,
        text!("group-is", name = &name, members = members),
    );
    state.session.choice.groups.insert(name, ids);
    Ok(())
}
