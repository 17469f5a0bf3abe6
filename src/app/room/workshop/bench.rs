//! The bench: a design, its figures, and the effect of each part for a slot. Figures take time to
//! compute, so they are cached until the design or the slot changes; drawing computes nothing.

use crate::app::action::Step;
use crate::text::Text;
use crate::workshop::{
    Air, Design, DesignFinding, FindingKind, FindingSeverity, Part, PartSlot, Sheet, parts_for,
};

const MOST_UNDONE: usize = 200;

/// A design being edited.
#[derive(Debug, Clone)]
pub struct Bench {
    design: Design,
    origin: Option<String>,
    done: Vec<Kept>,
    undone: Vec<Kept>,
    row: usize,
    part: Option<&'static str>,
    sheet: Sheet,
    findings: Vec<DesignFinding>,
    curves: Curves,
    candidates: Vec<Candidate>,
    /// The curves with the part under the cursor among the candidates, if that changes the design and fits.
    marked_curves: Option<Curves>,
}

/// The curves of a design.
#[derive(Debug, Clone, Default)]
pub struct Curves {
    /// Power in watts by speed in m/s.
    pub polar: Vec<(f64, f64)>,
    /// Hover or driving time in seconds by kilograms of payload added.
    pub endurance: Vec<(f64, f64)>,
}

impl Curves {
    fn of(design: &Design, air: Air) -> Self {
        Self {
            polar: design.polar(air),
            endurance: design.endurance_by_payload(air),
        }
    }
}

/// An earlier state of the design, with the name under which it was stored.
#[derive(Debug, Clone)]
struct Kept {
    design: Design,
    origin: Option<String>,
}

/// A line of the list of slots: parts of one kind in one slot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlotRow {
    pub slot: PartSlot,
    /// The part of the line; `None` for a line where a part can be added.
    pub part: Option<&'static Part>,
    /// The number of pieces of the part in the slot.
    pub count: usize,
}

/// A part that could go into the slot under the cursor.
#[derive(Debug, Clone)]
pub struct Candidate {
    pub part: &'static Part,
    /// The number of pieces of the part already in the slot.
    pub on_board: usize,
    /// The design's figures with this part; for a part on board, the current ones.
    pub sheet: Sheet,
    /// Why the part does not fit: a fault of the design in this slot, or a new fault in another
    /// slot.
    pub misfit: Option<Text>,
}

impl Default for Bench {
    fn default() -> Self {
        let design = Design::default();
        Self {
            sheet: Sheet::of(&design, Air::default()),
            design,
            origin: None,
            done: Vec::new(),
            undone: Vec::new(),
            row: 0,
            part: None,
            findings: Vec::new(),
            curves: Curves::default(),
            candidates: Vec::new(),
            marked_curves: None,
        }
    }
}

impl Bench {
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// The name of the trainee's own design on which this one is based.
    pub fn origin(&self) -> Option<&str> {
        self.origin.as_deref()
    }

    pub fn sheet(&self) -> &Sheet {
        &self.sheet
    }

    /// The problems of the design.
    pub fn findings(&self) -> &[DesignFinding] {
        &self.findings
    }

    /// The curves of the design.
    pub fn curves(&self) -> &Curves {
        &self.curves
    }

    /// The curves with the part under the cursor among the candidates, if that changes the design and fits.
    pub fn marked_curves(&self) -> Option<&Curves> {
        self.marked_curves.as_ref()
    }

    /// The parts for the slot under the cursor; those that do not fit come last.
    pub fn candidates(&self) -> &[Candidate] {
        &self.candidates
    }

    /// Whether nothing has been built or opened yet.
    pub fn is_untouched(&self) -> bool {
        self.design.is_empty() && self.done.is_empty() && self.undone.is_empty()
    }

    /// The lines of the list of slots.
    pub fn rows(&self) -> Vec<SlotRow> {
        rows(&self.design)
    }

    /// The index of the cursor among the slot rows.
    pub fn row(&self) -> usize {
        self.row
    }

    /// The slot under the cursor.
    pub fn slot(&self) -> PartSlot {
        let rows = self.rows();
        rows.get(self.row).map_or(PartSlot::Frame, |row| row.slot)
    }

    /// The index of the cursor among the candidates.
    pub fn at(&self) -> usize {
        let mut all = self.candidates.iter();
        let known = all.position(|candidate| Some(candidate.part.id) == self.part);
        known.unwrap_or(0)
    }

    /// The part under the cursor among the candidates.
    pub fn candidate(&self) -> Option<&Candidate> {
        self.candidates.get(self.at())
    }

    /// The severity of the worst finding about a slot.
    pub fn severity(&self, slot: PartSlot) -> Option<FindingSeverity> {
        let about = self.findings.iter().filter(|finding| finding.slot == slot);
        about.map(DesignFinding::severity).max()
    }

    /// Moves the cursor over the slots.
    pub fn move_row(&mut self, step: Step, air: Air) {
        let before = self.slot();
        self.row = step.apply(self.row, self.rows().len());
        if self.slot() != before {
            self.list(air);
            self.find_part(air);
        }
    }

    /// Moves the cursor to the next required slot without a part, if any.
    pub fn move_to_empty(&mut self, air: Air) {
        let rows = self.rows();
        let is_empty = |row: &SlotRow| row.part.is_none() && row.slot.is_required();
        let next = (self.row + 1..rows.len()).chain(0..self.row);
        if let Some(at) = next.into_iter().find(|&at| is_empty(&rows[at])) {
            self.row = at;
            self.list(air);
            self.find_part(air);
        }
    }

    /// Moves the cursor over the candidates.
    pub fn move_part(&mut self, step: Step, air: Air) {
        let at = step.apply(self.at(), self.candidates.len());
        self.part = self.candidates.get(at).map(|candidate| candidate.part.id);
        self.trace(air);
    }

    /// Installs the part under the cursor. Returns false if that changes nothing.
    pub fn put_in(&mut self, air: Air) -> bool {
        let changed = self.candidate().map(|it| self.design.with(it.part));
        changed.is_some_and(|changed| self.change(changed, air))
    }

    /// Removes one piece of a part. Returns false if the design has none.
    pub fn take_out(&mut self, part: &Part, air: Air) -> bool {
        self.change(self.design.without(part), air)
    }

    /// Undoes one change; returns false if there is none.
    pub fn undo(&mut self, air: Air) -> bool {
        let Some(before) = self.done.pop() else {
            return false;
        };
        self.undone.push(self.kept());
        self.lay(before, air);
        true
    }

    /// Redoes the change undone last; returns false if there is none.
    pub fn redo(&mut self, air: Air) -> bool {
        let Some(after) = self.undone.pop() else {
            return false;
        };
        self.done.push(self.kept());
        self.lay(after, air);
        true
    }

    /// Opens another design on the bench; that can be undone.
    pub fn open(&mut self, design: Design, origin: Option<String>, air: Air) {
        if !self.is_untouched() {
            self.remember();
        }
        self.row = 0;
        self.part = None;
        self.lay(Kept { design, origin }, air);
        self.find_part(air);
    }

    /// Replaces the design by a renamed one, stored under the name `origin`; this cannot be undone.
    pub fn rename(&mut self, design: Design, origin: Option<String>) {
        (self.design, self.origin) = (design, origin);
    }

    pub fn renew(&mut self, air: Air) {
        self.sheet = Sheet::of(&self.design, air);
        self.findings = self.design.findings_with(self.sheet.performance.as_ref());
        self.curves = Curves::of(&self.design, air);
        self.list(air);
        self.trace(air);
    }

    fn change(&mut self, design: Design, air: Air) -> bool {
        if design == self.design {
            return false;
        }
        self.remember();
        let origin = self.origin.take();
        self.lay(Kept { design, origin }, air);
        true
    }

    fn remember(&mut self) {
        self.done.push(self.kept());
        if self.done.len() > MOST_UNDONE {
            self.done.remove(0);
        }
        self.undone.clear();
    }

    fn kept(&self) -> Kept {
        Kept {
            design: self.design.clone(),
            origin: self.origin.clone(),
        }
    }

    fn lay(&mut self, kept: Kept, air: Air) {
        let slot = self.slot();
        (self.design, self.origin) = (kept.design, kept.origin);
        // The slots below have moved by the payload lines added or removed.
        let rows = self.rows();
        if rows.get(self.row).is_none_or(|row| row.slot != slot) {
            let at = rows.iter().rposition(|row| row.slot == slot);
            self.row = at.unwrap_or_default();
        }
        self.renew(air);
    }

    /// Puts the cursor on the part in the current row, or on the first candidate.
    fn find_part(&mut self, air: Air) {
        let rows = self.rows();
        let there = rows.get(self.row).and_then(|row| row.part);
        let first = self.candidates.first().map(|candidate| candidate.part);
        self.part = there.or(first).map(|part| part.id);
        self.trace(air);
    }

    /// Computes the curves with the part under the cursor.
    fn trace(&mut self, air: Air) {
        let usable = self.candidate();
        let usable = usable.filter(|it| it.on_board == 0 && it.misfit.is_none());
        let changed = usable.map(|candidate| self.design.with(candidate.part));
        self.marked_curves = changed.map(|design| Curves::of(&design, air));
    }

    fn list(&mut self, air: Air) {
        let slot = self.slot();
        let kind = self.design.kind();
        let mut candidates: Vec<Candidate> = parts_for(slot)
            .filter(|part| slot == PartSlot::Frame || part.fits(kind))
            .map(|part| self.consider(part, air))
            .collect();
        candidates.sort_by_key(|candidate| candidate.misfit.is_some());
        self.candidates = candidates;
    }

    fn consider(&self, part: &'static Part, air: Air) -> Candidate {
        let there = self.design.in_slot(part.slot()).iter();
        let on_board = there.filter(|other| other.id == part.id).count();
        let changed = self.design.with(part);
        if changed == self.design {
            return Candidate {
                part,
                on_board,
                sheet: self.sheet.clone(),
                misfit: None,
            };
        }
        let sheet = Sheet::of(&changed, air);
        let findings = changed.findings_with(sheet.performance.as_ref());
        Candidate {
            part,
            on_board,
            // For a part on board, the current figures are shown, without a second one of its kind.
            sheet: if on_board > 0 {
                self.sheet.clone()
            } else {
                sheet
            },
            misfit: self.misfit(part.slot(), &findings),
        }
    }

    /// The first fault that a change causes: any fault in the changed slot, or a new one in another
    /// slot. A part that is missing now is none: a chassis for a drone begins a robot.
    fn misfit(&self, slot: PartSlot, after: &[DesignFinding]) -> Option<Text> {
        let mut faults = after
            .iter()
            .filter(|it| it.severity() == FindingSeverity::Fault)
            .filter(|it| it.kind != FindingKind::Missing);
        let was_there = |fault: &DesignFinding| {
            let mut before = self.findings.iter();
            before.any(|it| it.slot == fault.slot && it.kind == fault.kind)
        };
        let fault = faults.find(|fault| fault.slot == slot || !was_there(fault))?;
        Some(fault.text.clone())
    }
}

/// The lines of a design's list of slots: one for each kind of part in a slot, one for each empty
/// slot of its kind of vehicle, and one for a further payload.
pub fn rows(design: &Design) -> Vec<SlotRow> {
    let mut rows: Vec<SlotRow> = Vec::new();
    let own = design.kind().slots();
    for slot in PartSlot::ALL {
        let there = design.in_slot(slot);
        if there.is_empty() && !own.contains(&slot) {
            continue;
        }
        let first = rows.len();
        for &part in there {
            let same = |row: &&mut SlotRow| row.part.is_some_and(|it| it.id == part.id);
            match rows[first..].iter_mut().find(same) {
                Some(row) => row.count += 1,
                None => rows.push(SlotRow {
                    slot,
                    part: Some(part),
                    count: 1,
                }),
            }
        }
        let takes_more = slot == PartSlot::Payload && there.len() < slot.room();
        if there.is_empty() || takes_more {
            rows.push(SlotRow {
                slot,
                part: None,
                count: 0,
            });
        }
    }
    rows
}
