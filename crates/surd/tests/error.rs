//! Every error message is one line that states the given value and the remedy.

use exact_surd::{Error, Surd, parse};
use num_rational::BigRational;

/// Asserts that the message is one plain line that contains all of `parts`.
fn assert_message(error: &Error, parts: &[&str]) {
    let message = error.to_string();
    assert!(
        !message.chars().any(char::is_control),
        "{message:?} is longer than one line"
    );
    for part in parts {
        assert!(
            message.contains(part),
            "{message:?} does not contain {part:?}"
        );
    }
}

#[test]
fn negative_radicand() {
    let negative = BigRational::new((-7).into(), 3.into());
    let error = Surd::sqrt(negative.clone()).unwrap_err();
    assert!(matches!(&error, Error::NegativeRadicand { given, .. } if *given == negative));
    assert_message(&error, &["-7/3", "must not be negative"]);
}

#[test]
fn syntax() {
    let refused = [
        (parse::rational("a third").unwrap_err(), "a third", "6/5"),
        (
            parse::rational("1/0").unwrap_err(),
            "1/0",
            "other than zero",
        ),
        (parse::integer("1.5").unwrap_err(), "1.5", "integer"),
        (
            parse::rational("line\nbreak\u{7}").unwrap_err(),
            "line\\nbreak",
            "6/5",
        ),
    ];
    for (error, given, remedy) in refused {
        assert!(matches!(error, Error::Syntax { .. }));
        assert_message(&error, &[given, remedy]);
    }
    let long = "9".repeat(20_000);
    let error = parse::rational(&long).unwrap_err();
    assert_message(&error, &["999…", "5000 digits"]);
    assert!(error.to_string().len() < 200);
}
