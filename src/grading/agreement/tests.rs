use super::*;

/// The marks of a grader for elements `e0`, `e1` and so on; 0 is not observed.
fn marks(numbers: &[u8]) -> GraderMarks {
    let graded = |at: usize| GradedElement {
        user: "anna".to_owned(),
        record: "r".to_owned(),
        element: format!("e{at}"),
    };
    let all = numbers.iter().enumerate();
    all.map(|(at, number)| (graded(at), Mark::try_from(*number).ok()))
        .collect()
}

#[test]
fn equal_marks_agree_fully() {
    let one = marks(&[1, 2, 3, 4, 5]);
    let found = agreement(&one, &one);
    assert_eq!((found.marks, found.equal, found.within_one), (5, 5, 5));
    assert_eq!(found.kappa, Some(1.0));
    assert!(found.mean_difference.abs() < 1e-9);
    assert!(found.far_apart.is_empty());
}

/// By hand: the mean squared difference of the marks is 2/4, that of all 16 pairs of a mark of one and a mark of the
/// other 24/16. Kappa is 1 - 0.5 / 1.5.
#[test]
fn kappa_follows_from_the_differences_and_those_of_chance() {
    let found = agreement(&marks(&[2, 2, 4, 4]), &marks(&[2, 3, 4, 3]));
    assert_eq!((found.equal, found.within_one), (2, 4));
    assert_eq!(found.kappa, Some(0.67));
    assert!(found.mean_difference.abs() < 1e-9);
}

#[test]
fn opposite_marks_are_worse_than_chance_and_listed_the_farthest_first() {
    let found = agreement(&marks(&[1, 5, 3]), &marks(&[4, 1, 3]));
    assert!(found.kappa.is_some_and(|it| it < 0.0), "{found:?}");
    let steps: Vec<u8> = found.far_apart.iter().map(Disagreement::steps).collect();
    assert_eq!(steps, [4, 3]);
}

#[test]
fn only_what_both_have_graded_is_compared() {
    let found = agreement(&marks(&[3, 0, 0, 2]), &marks(&[3, 4, 0]));
    assert_eq!((found.marks, found.observed_by_one), (1, 1));
    assert_eq!(found.kappa, None, "one and the same mark");
    assert_eq!(agreement(&marks(&[]), &marks(&[3])), Agreement::default());
}
