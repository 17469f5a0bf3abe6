//! The verb for a class.

use super::{Built, Problem, console};
use crate::class::{Deed, LessonDirection, Words};
use crate::language::VehicleChoice;
use crate::language::argument::{Argument, Arguments, Kind, Unit};
use crate::language::console::{
    ClassLine, ConsoleLine, GradingLine, Rating, ReplayedTrainees, Report, SeatChoice,
};
use crate::language::names::NameList;
use crate::language::verb::{Form, Scope, VerbRow};
use crate::text;
use crate::vehicle_id::VehicleId;
use crate::verb::Verb;

/// The word for all seats.
const ALL: &str = "@all";

pub(super) static ROWS: &[VerbRow] = &[VerbRow {
    verb: Verb::unsent("class"),
    scope: Scope::Console,
    aliases: &[],
    examples: &[
        "class",
        "class message @anna land first",
        "class freeze @all",
        "class resume",
        "class inject gust when t > 60",
        "class injects @anna",
        "class disarm",
        "class capture before the turn",
        "class capture low battery @all",
        "class recall 1",
        "class take @anna 3",
        "class say @anna 3 takeoff 20",
        "class give",
        "class watch @anna",
        "class tiles",
        "class state",
        "class replay anna with bohdan",
        "class show",
        "class show stop",
        "class results",
        "class fly @all 00 hold",
        "class start @all",
        "class lesson @all first-lesson",
        "class lesson next",
        "class grade",
        "class rate 4",
        "class remark answered at once",
        "class cite 1",
        "class exam @all two-missions",
        "class exam stop",
        "class join",
    ],
    forms: &[
        Form::new(&[], |_| console(ConsoleLine::Report(Report::Class))),
        Form::new(&[Argument::flag("message", ""), SEAT, TEXT], |given| {
            give(given, |text| Deed::Message { text: text.into() })
        }),
        Form::new(&[Argument::flag("hint", ""), SEAT], |given| {
            give(given, |_| Deed::Hint)
        }),
        Form::new(
            &[Argument::flag("mark", ""), SEAT, TEXT.optional()],
            |given| give(given, |text| Deed::Mark { text: text.into() }),
        ),
        Form::new(&[Argument::flag("freeze", ""), SEAT], |given| {
            give(given, |_| Deed::Freeze)
        }),
        Form::new(&[Argument::flag("resume", ""), SEAT], |given| {
            give(given, |_| Deed::Resume)
        }),
        Form::new(
            &[Argument::flag("inject", ""), SEAT, INJECT, CONDITION],
            |given| {
                let when = given.word("condition").map(Into::into);
                let name = given.required_word("name")?.into();
                instruct(given, Deed::Inject { name, when })
            },
        ),
        Form::new(&[Argument::flag("injects", ""), SEAT], |given| {
            console(ConsoleLine::Class(ClassLine::Injects(seats(given))))
        }),
        Form::new(
            &[Argument::flag("disarm", ""), SEAT, INJECT.optional()],
            |given| {
                let name = given.word("name").map(Into::into);
                instruct(given, Deed::Disarm { name })
            },
        ),
        Form::new(&[Argument::flag("watch", ""), SEAT], |given| {
            console(ConsoleLine::Class(ClassLine::Watch(seats(given))))
        }),
        Form::new(&[Argument::flag("unwatch", "")], |_| {
            console(ConsoleLine::Class(ClassLine::Unwatch))
        }),
        Form::new(&[Argument::flag("tiles", "")], |_| {
            console(ConsoleLine::Class(ClassLine::Tiles))
        }),
        Form::new(&[Argument::flag("state", "")], |_| {
            console(ConsoleLine::Class(ClassLine::State))
        }),
        Form::new(&[Argument::flag("replay", ""), TRAINEE, BESIDE], |given| {
            let [trainee, beside] =
                ["trainee", "beside"].map(|name| given.word(name).map(str::to_owned));
            let trainees = ReplayedTrainees { trainee, beside };
            console(ConsoleLine::Class(ClassLine::Replay(trainees)))
        }),
        Form::new(&[SHOW, Argument::flag("stop", "")], |_| {
            console(ConsoleLine::Class(ClassLine::StopShow))
        }),
        Form::new(&[SHOW, SEAT], |given| {
            console(ConsoleLine::Class(ClassLine::Show(seats(given))))
        }),
        Form::new(&[Argument::flag("results", "")], |_| {
            console(ConsoleLine::Class(ClassLine::Results))
        }),
        Form::new(&[Argument::flag("grade", ""), TRAINEE, RUBRIC], |given| {
            let [trainee, rubric] =
                ["trainee", "rubric"].map(|name| given.word(name).map(str::to_owned));
            grade(GradingLine::Open { trainee, rubric })
        }),
        Form::new(&[Argument::flag("rate", ""), RATING], |given| {
            let word = given.required_word("rating")?;
            let unknown = || Problem::new("rating", text!("grammar-no-name", word = word));
            let rating = Rating::by_name(word).ok_or_else(unknown)?;
            grade(GradingLine::Rate(rating))
        }),
        Form::new(&[Argument::flag("remark", ""), TEXT], |given| {
            let text = given.required_word("text")?.to_owned();
            grade(GradingLine::Remark(text))
        }),
        Form::new(&[Argument::flag("cite", ""), BOOKMARK], |given| {
            grade(GradingLine::Cite(given.required("bookmark")? as usize))
        }),
        Form::new(
            &[Argument::flag("fly", ""), SEAT, MISSION, EXAM, HOLD],
            |given| {
                let mission = given.required_word("mission")?.into();
                let [exam, hold] = ["exam", "hold"].map(|word| given.flag(word));
                instruct(
                    given,
                    Deed::Fly {
                        mission,
                        exam,
                        hold,
                    },
                )
            },
        ),
        Form::new(&[Argument::flag("start", ""), SEAT], |given| {
            give(given, |_| Deed::Start)
        }),
        Form::new(&[LESSON, Argument::flag("next", ""), SEAT], |given| {
            direct(given, LessonDirection::Next)
        }),
        Form::new(&[LESSON, Argument::flag("skip", ""), SEAT], |given| {
            direct(given, LessonDirection::Skip)
        }),
        Form::new(&[LESSON, Argument::flag("back", ""), SEAT], |given| {
            direct(given, LessonDirection::Back)
        }),
        Form::new(&[LESSON, Argument::flag("stop", ""), SEAT], |given| {
            direct(given, LessonDirection::Stop)
        }),
        Form::new(&[LESSON], |_| {
            console(ConsoleLine::Class(ClassLine::Lessons))
        }),
        Form::new(&[LESSON, SEAT, LESSON_NAME], |given| {
            let lesson = given.required_word("name")?.to_owned();
            let seats = seats(given);
            console(ConsoleLine::Class(ClassLine::Teach { seats, lesson }))
        }),
        Form::new(&[EXAM_WORD, Argument::flag("stop", "")], |_| {
            console(ConsoleLine::Class(ClassLine::StopExam))
        }),
        Form::new(&[EXAM_WORD, SEAT, EXAM_NAME], |given| {
            let exam = given.required_word("name")?.to_owned();
            let seats = seats(given);
            console(ConsoleLine::Class(ClassLine::Examine { seats, exam }))
        }),
        Form::new(&[Argument::flag("end", ""), SEAT], |given| {
            give(given, |_| Deed::End)
        }),
        Form::new(
            &[Argument::flag("capture", ""), SEAT, TEXT.optional()],
            |given| give(given, |text| Deed::Capture { name: text.into() }),
        ),
        Form::new(&[Argument::flag("recall", ""), SEAT, SITUATION], |given| {
            give(given, |text| Deed::Recall {
                situation: text.into(),
            })
        }),
        Form::new(
            &[Argument::flag("take", ""), SEAT, VEHICLES.optional()],
            |given| {
                let vehicles = flown(given)?;
                instruct(given, Deed::TakeOver { vehicles })
            },
        ),
        Form::new(
            &[Argument::flag("give", ""), SEAT, VEHICLES.optional()],
            |given| {
                let vehicles = flown(given)?;
                instruct(given, Deed::HandBack { vehicles })
            },
        ),
        Form::new(&[Argument::flag("say", ""), SEAT, TEXT], |given| {
            let text = given.required_word("text")?;
            let line =
                Words::whole(text).ok_or_else(|| Problem::new("text", text!("class-line-long")))?;
            // A group at the end belongs to the command; one at the beginning would be the trainee's.
            if given.word("@seat").is_none() && text.starts_with('@') {
                return Err(unknown_seat(text.split(' ').next().unwrap_or(text)));
            }
            instruct(given, Deed::Command { line })
        }),
        Form::new(&[Argument::flag("join", "")], |_| {
            console(ConsoleLine::Class(ClassLine::Join))
        }),
        Form::new(&[Argument::flag("leave", "")], |_| {
            console(ConsoleLine::Class(ClassLine::Leave))
        }),
    ],
}];

const SEAT: Argument =
    Argument::value("@seat", Kind::Name(NameList::Seat), "argument-seat").optional();
const TEXT: Argument = Argument::value("text", Kind::Rest, "");
const SITUATION: Argument = Argument::value(
    "text",
    Kind::Proposed(NameList::Situation),
    "argument-situation",
);
const VEHICLES: Argument = Argument::value("vehicles", Kind::Vehicles, "argument-class-vehicles");
const INJECT: Argument = Argument::value("name", Kind::Name(NameList::SeatInject), "");
const CONDITION: Argument =
    Argument::keyed("when", "condition", Kind::Rest, "argument-condition").optional();

const MISSION: Argument = Argument::value("mission", Kind::Name(NameList::Mission), "");
const EXAM: Argument = Argument::flag("exam", "argument-exam").optional();
const HOLD: Argument = Argument::flag("hold", "argument-hold").optional();
const EXAM_WORD: Argument = Argument::flag("exam", "");
const EXAM_NAME: Argument =
    Argument::value("name", Kind::Name(NameList::Exam), "argument-exam-name");
const LESSON: Argument = Argument::flag("lesson", "");
const LESSON_NAME: Argument =
    Argument::value("name", Kind::Name(NameList::Lesson), "argument-lesson");

const TRAINEE: Argument =
    Argument::value("trainee", Kind::Name(NameList::Trainee), "argument-trainee").optional();
const BESIDE: Argument = Argument::keyed(
    "with",
    "beside",
    Kind::Name(NameList::Trainee),
    "argument-beside",
)
.optional();
const SHOW: Argument = Argument::flag("show", "");
const RUBRIC: Argument = Argument::keyed(
    "with",
    "rubric",
    Kind::Name(NameList::Rubric),
    "argument-rubric",
)
.optional();
const RATING: Argument = Argument::value("rating", Kind::Choice(Rating::NAMES), "argument-rating");
const BOOKMARK: Argument = Argument::value(
    "bookmark",
    Kind::Whole(Unit::None, 1.0, 1000.0),
    "argument-bookmark",
);

fn grade(line: GradingLine) -> Built {
    console(ConsoleLine::Class(ClassLine::Grading(line)))
}

fn direct(given: &Arguments, direction: LessonDirection) -> Built {
    let seats = seats(given);
    console(ConsoleLine::Class(ClassLine::Direct { seats, direction }))
}

fn give(given: &Arguments, deed: fn(&str) -> Deed) -> Built {
    let text = given.word("text").unwrap_or_default();
    check_seat(given, text)?;
    instruct(given, deed(text))
}

/// Checks that a name that no seat has does not become part of a text to another seat.
fn check_seat(given: &Arguments, text: &str) -> Result<(), Problem> {
    let mut words = text.split_whitespace();
    let ends = [words.next(), words.next_back()];
    let unknown = ends
        .into_iter()
        .flatten()
        .find(|word| word.starts_with('@'));
    match unknown.filter(|_| given.word("@seat").is_none()) {
        Some(word) => Err(unknown_seat(word)),
        None => Ok(()),
    }
}

fn unknown_seat(word: &str) -> Problem {
    Problem::new("text", text!("class-unknown-seat", word = word))
        .with_help(text!("class-unknown-seat-help"))
}

/// The vehicles of a seat; empty for all.
fn flown(given: &Arguments) -> Result<Vec<VehicleId>, Problem> {
    match given.vehicles("vehicles") {
        None | Some(VehicleChoice::All) => Ok(Vec::new()),
        Some(VehicleChoice::Ids(vehicles)) => Ok(vehicles),
        Some(VehicleChoice::Group(group)) => {
            let message = text!("class-unknown-seat", word = format!("@{group}"));
            Err(Problem::new("vehicles", message))
        }
        Some(VehicleChoice::None | VehicleChoice::Filter | VehicleChoice::Invert) => {
            Err(Problem::new("vehicles", text!("class-which-vehicles")))
        }
    }
}

fn instruct(given: &Arguments, deed: Deed) -> Built {
    let seats = seats(given);
    console(ConsoleLine::Class(ClassLine::Give { seats, deed }))
}

fn seats(given: &Arguments) -> SeatChoice {
    match given.word("@seat") {
        None => SeatChoice::Addressed,
        Some(ALL) => SeatChoice::All,
        Some(name) => SeatChoice::Named(name.trim_start_matches('@').to_owned()),
    }
}
