use super::*;

fn rubric() -> Rubric {
    let source = include_str!("../../../rubrics/notechs.toml");
    Rubric::parse("notechs", source).expect("it is good")
}

fn mark(number: u8) -> Mark {
    Mark::try_from(number).expect("1 to 5")
}

/// The ids of the elements that are open.
fn open(sheet: &GradeSheet) -> Vec<String> {
    sheet.open(&rubric()).map(|it| it.id.clone()).collect()
}

#[test]
fn the_extremes_need_a_remark_or_a_bookmark() {
    let mut sheet = GradeSheet::new(&rubric(), "petro");
    let all = open(&sheet);
    assert_eq!(all.len(), 11);
    for id in &all {
        sheet.rate(id, Some(mark(3)));
    }
    assert!(open(&sheet).is_empty());
    sheet.rate("planning", Some(mark(5)));
    sheet.rate("choice", Some(mark(1)));
    assert_eq!(open(&sheet), ["planning", "choice"]);
    let rubric = rubric();
    let elements = rubric.elements().filter(|it| it.id == "planning");
    assert_eq!(sheet.mean(elements), None, "it does not count yet");
    let grade = |sheet: &mut GradeSheet, id: &str, change: fn(&mut Grade)| {
        change(sheet.grade_mut(id).expect("graded"));
    };
    grade(&mut sheet, "planning", |it| it.text = " ".to_owned());
    grade(&mut sheet, "choice", |it| {
        it.cite(Duration::from_millis(61_500));
    });
    assert_eq!(open(&sheet), ["planning"], "blanks are no reason");
    grade(&mut sheet, "planning", |it| {
        it.text = "pairs by height".to_owned();
    });
    grade(&mut sheet, "choice", |it| {
        it.cite(Duration::from_millis(61_500));
    });
    assert_eq!(open(&sheet), ["choice"], "cited twice is not cited");
}

#[test]
fn what_was_not_observed_is_graded_but_has_no_part_in_the_mean() {
    let rubric = rubric();
    let mut sheet = GradeSheet::new(&rubric, "petro");
    assert_eq!(sheet.mean(rubric.elements()), None);
    sheet.rate("planning", Some(mark(2)));
    sheet.rate("standards", Some(mark(4)));
    sheet.rate("workload", None);
    assert_eq!(sheet.mean(rubric.elements()), Some(3.0));
    assert_eq!(open(&sheet).len(), 8);
    sheet.clear("workload");
    assert_eq!(open(&sheet).len(), 9);
}

#[test]
fn a_sheet_is_kept_as_text_and_refuses_other_marks() {
    let mut sheet = GradeSheet::new(&rubric(), "petro");
    sheet.rate("planning", Some(mark(4)));
    sheet.rate("workload", None);
    let text = toml::to_string_pretty(&sheet).expect("written");
    assert_eq!(toml::from_str::<GradeSheet>(&text).expect("read"), sheet);
    let other = text.replace("mark = 4", "mark = 6");
    let fault = toml::from_str::<GradeSheet>(&other).expect_err("no mark");
    assert!(fault.message().contains("from 1 to 5"), "{fault}");
}
