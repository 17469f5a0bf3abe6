//! A flight that is being graded at the desk.

use sortie::text::Language;

use crate::console::class::grading;

#[test]
fn elements_marks_and_what_the_record_says() {
    for language in Language::ALL {
        let mut console = grading(language);
        console.press("1").press("down").press("down").press("5");
        console.press("c").write("2").press("enter");
        console
            .press("enter")
            .write("paired by height")
            .press("enter");
        for (width, height) in [(80, 24), (120, 40), (200, 50)] {
            let name = format!("grading_{}_{width}x{height}", language.code());
            insta::assert_snapshot!(name, console.screen(width, height));
        }
    }
}
