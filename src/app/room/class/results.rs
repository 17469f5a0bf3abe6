//! The pages with the results of the class.

use crate::app::action::Step;
use crate::class_results::ClassResults;
use crate::text;
use crate::text::Text;

/// A page of the results of the class.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResultsPage {
    /// The objectives, the least known first.
    Objectives,
    /// How the scores of each mission are spread.
    Missions,
    /// How the mastery of each skill is spread.
    Skills,
    /// A row per trainee, with the scores of the missions.
    ByMission,
    /// A row per trainee, with the mastery of the skills.
    BySkill,
}

impl ResultsPage {
    /// All pages in their order.
    pub const ALL: [Self; 5] = [
        Self::Objectives,
        Self::Missions,
        Self::Skills,
        Self::ByMission,
        Self::BySkill,
    ];

    /// What the page shows.
    pub fn title(self) -> Text {
        match self {
            Self::Objectives => text!("class-report-objectives"),
            Self::Missions => text!("class-report-spread"),
            Self::Skills => text!("class-report-skill-spread"),
            Self::ByMission => text!("class-results-by-mission"),
            Self::BySkill => text!("class-report-skills"),
        }
    }

    /// The message that says why the page has no rows although records were handed in.
    pub fn why_empty(self) -> &'static str {
        match self {
            Self::Objectives | Self::Missions | Self::ByMission => "class-results-no-tries",
            Self::Skills | Self::BySkill => "class-results-no-skills",
        }
    }

    /// Its number, from 1.
    pub fn number(self) -> usize {
        self as usize + 1
    }

    /// The page that many pages further on; the first one follows the last one.
    pub(super) fn after(self, pages: usize) -> Self {
        Self::ALL[(self as usize + pages) % Self::ALL.len()]
    }
}

/// The page of the results that is shown, and how far it is scrolled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ResultsView {
    page: ResultsPage,
    /// The first row that is to be shown.
    row: usize,
}

impl ResultsView {
    /// The beginning of a page.
    pub(in crate::app) fn of(page: ResultsPage) -> Self {
        Self { page, row: 0 }
    }

    /// The page that follows.
    pub(in crate::app) fn next(self) -> Self {
        Self::of(self.page.after(1))
    }

    /// Which of the tables is shown.
    pub fn page(self) -> ResultsPage {
        self.page
    }

    /// The first row of the page that is to be shown.
    pub fn row(self) -> usize {
        self.row
    }

    /// Moves to another row, or to another page.
    pub(super) fn step(&mut self, step: Step, results: Option<&ClassResults>) {
        let rows = results.map_or(0, |results| match self.page {
            ResultsPage::Objectives => results.objectives.len(),
            ResultsPage::Missions => results.missions.len(),
            ResultsPage::Skills => results.skills.len(),
            ResultsPage::ByMission | ResultsPage::BySkill => results.trainees.len(),
        });
        match step {
            Step::Right => *self = self.next(),
            Step::Left => *self = Self::of(self.page.after(ResultsPage::ALL.len() - 1)),
            _ => self.row = step.apply(self.row, rows),
        }
    }
}
