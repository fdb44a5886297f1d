//! Stackings of many layers, which take little memory if they have few sign changes, and rejected stackings.

use cannonpile::Error;
use cannonpile::lattice::{MAX_LAYERS, Sign};
use cannonpile::stacking::{MAX_RUNS, Notation, Run, Stacking};

/// The length of the longest accepted text, in bytes.
const LONGEST: usize = 4_000_000;

/// 10¹⁵ layers with three sign changes.
const LONG: &str = "(333333333333333,1,666666666666664,1)";

#[test]
fn a_long_stacking_has_few_runs() {
    let stacking: Stacking = LONG.parse().expect("four runs");
    assert_eq!(stacking.layers(), 10_i128.pow(15));
    assert_eq!((stacking.changes(), stacking.runs().len()), (3, 4));
    assert_eq!(stacking.in_notation(Notation::Zhdanov).to_string(), LONG);
    let reversed = stacking
        .reversed()
        .in_notation(Notation::Zhdanov)
        .to_string();
    assert_eq!(reversed, "(1,666666666666664,1,333333333333333)");
    assert_eq!(stacking.mirrored().layers(), stacking.layers());
    assert!(
        stacking
            .mirrored()
            .signs()
            .take(5)
            .all(|sign| sign == Sign::Minus)
    );
}

/// A thousand round trips. They would not end if the work or memory grew with the 10¹⁵ layers.
#[test]
fn a_long_stacking_is_read_and_printed_quickly() {
    for _ in 0..1_000 {
        let stacking: Stacking = LONG.parse().expect("four runs");
        assert_eq!(stacking.in_notation(Notation::Zhdanov).to_string(), LONG);
        assert_eq!(stacking.reversed().mirrored().layers(), 10_i128.pow(15));
    }
}

/// The error is one line that contains the value and the remedy.
fn is_rejected(text: &str, because: &str) {
    let refusal = text.parse::<Stacking>().expect_err(text);
    let message = refusal.to_string();
    assert!(message.contains(because), "{text}: {message}");
    assert!(!message.contains(char::is_control), "{message:?}");
    assert!(message.len() < 300, "{message}");
}

#[test]
fn invalid_texts_are_rejected() {
    let texts = [
        "", "AA", "ABB", "ABCC", "ABD", "abc", "A B", "AB+", "+x", "+ -", " +", "+\n", "++h", "hA",
        "ch+", "x", "H", "C+", "(0)", "(1,0)", "(1,,2)", "(1,-2)", "( 1)", "(1 )", "(1,)", "(,1)",
        "(,)", "(+1)", "(", ")", "(1", "1)", "1,2", "(1)(1)", "(1.5)", "(1e3)", "(٣)", "()()",
        "((1))", "−+", "＋", "\0",
    ];
    for text in texts {
        let quoted: String = text.chars().flat_map(char::escape_debug).collect();
        is_rejected(
            text,
            &format!("'{quoted}' is not a stacking such as ++-+, ABCBC, chh or (2,1,1)"),
        );
    }
}

#[test]
fn long_texts_are_rejected() {
    let letters = "c".repeat(LONGEST);
    let stacking: Stacking = letters.parse().expect("one run at the limit");
    assert_eq!(stacking.layers(), 4_000_002);
    let signs = "+".repeat(LONGEST + 1);
    let shown = format!(
        "'{}…[4000001 characters]…{}' is not a stacking of at most 4000000 characters",
        "+".repeat(30),
        "+".repeat(12)
    );
    is_rejected(&signs, &shown);
}

#[test]
fn stackings_with_too_many_runs_are_rejected() {
    let hcp = |steps: usize| "+-".repeat(steps / 2);
    let most: Stacking = hcp(MAX_RUNS).parse().expect("a stacking at the limit");
    assert_eq!(most.changes() + 1, MAX_RUNS);
    let because = "more than 1000000 runs is too long to store: use fewer sign changes";
    is_rejected(&hcp(MAX_RUNS + 2), because);
    is_rejected(&"h".repeat(MAX_RUNS), because);
    is_rejected(&"AB".repeat(MAX_RUNS / 2 + 1), because);
    let layers = i128::try_from(MAX_RUNS).expect("small") + 1;
    assert_eq!(
        Stacking::hcp(layers).expect("a stacking at the limit"),
        most
    );
    for refusal in [
        Stacking::hcp(layers + 1),
        Stacking::hcp(MAX_LAYERS),
        Stacking::dhcp(MAX_LAYERS),
    ] {
        assert!(matches!(
            refusal,
            Err(Error::TooManyRuns {
                limit: MAX_RUNS,
                ..
            })
        ));
    }
}

#[test]
fn stackings_with_too_many_layers_are_rejected() {
    let because =
        "layers must be at least 1 and at most 10^36, not 1000000000000000000000000000000000001";
    let most = MAX_LAYERS - 1;
    let tallest: Stacking = format!("({most})")
        .parse()
        .expect("a stacking at the limit");
    assert_eq!(
        tallest,
        Stacking::fcc(MAX_LAYERS).expect("a stacking at the limit")
    );
    assert_eq!(
        tallest.in_notation(Notation::Zhdanov).to_string(),
        format!("({most})")
    );
    is_rejected(&format!("({MAX_LAYERS})"), because);
    is_rejected(&format!("({most},1)"), because);
    is_rejected(&format!("(1,{most})"), because);
    let tall = format!("({},{})", i128::MAX, i128::MAX);
    is_rejected(&tall, "layers must be at least 1 and at most 10^36");
    // The number of steps exceeds the integer type.
    is_rejected(&format!("({})", "9".repeat(50)), "is not a stacking");
    for layers in [0, -1, i128::MIN, MAX_LAYERS + 1, i128::MAX] {
        for made in [
            Stacking::fcc(layers),
            Stacking::hcp(layers),
            Stacking::dhcp(layers),
        ] {
            assert_eq!(
                made,
                Err(Error::Layers {
                    given: layers.into()
                })
            );
        }
    }
}

#[test]
fn invalid_runs_are_rejected() {
    let run = |sign, steps| Run { sign, steps };
    for steps in [-1, i128::MIN] {
        let made = Stacking::from_runs([run(Sign::Plus, 3), run(Sign::Plus, steps)]);
        assert!(matches!(made, Err(Error::RunLength { given, .. }) if given == steps));
    }
    let twice = [run(Sign::Plus, i128::MAX), run(Sign::Plus, i128::MAX)];
    assert!(matches!(
        Stacking::from_runs(twice),
        Err(Error::Layers { .. })
    ));
    let halves = [
        run(Sign::Minus, MAX_LAYERS / 2),
        run(Sign::Minus, MAX_LAYERS / 2 - 1),
    ];
    let joined = Stacking::from_runs(halves).expect("a stacking at the limit");
    assert_eq!((joined.layers(), joined.runs().len()), (MAX_LAYERS, 1));
    let more = halves.into_iter().chain([run(Sign::Plus, 1)]);
    let given = (MAX_LAYERS + 1).into();
    assert_eq!(Stacking::from_runs(more), Err(Error::Layers { given }));
}

/// The error names the position of the fault in a long text, and the character there.
#[test]
fn the_fault_of_a_long_text_is_located() {
    let long = "1,".repeat(40);
    for (text, position, found) in [
        (format!("x{}", "+".repeat(70)), 1, Some('x')),
        (format!("{}x+", "+".repeat(70)), 71, Some('x')),
        // Two equal letters. The second is wrong.
        (format!("{}CA", "ABC".repeat(30)), 91, Some('C')),
        (format!("{}xc", "ch".repeat(40)), 81, Some('x')),
        // Ten characters into the brackets, and in the middle of a length.
        (format!("(12,345,67x8,{long}1)"), 11, Some('x')),
        (format!("({long}x)"), 82, Some('x')),
        (format!("({long}12,0,{long}1)"), 85, Some('0')),
        (format!("-({long}x)"), 83, Some('x')),
        (format!("({long}1"), 83, None),
    ] {
        match text.parse::<Stacking>() {
            Err(Error::Misspelled {
                position: at,
                found: there,
                ..
            }) => assert_eq!((at, there), (position, found), "{text}"),
            other => panic!("{text}: {other:?}"),
        }
    }
}

#[test]
fn a_number_of_layers_beyond_the_integers_is_rejected() {
    let beyond = format!("({})", "9".repeat(50));
    is_rejected(&beyond, "is not a stacking of at most 10^36 layers");
    // 39 digits exceed 2^127. A number with 38 digits parses, but exceeds the limit.
    is_rejected(
        &format!("(1,{})", "9".repeat(39)),
        "of at most 10^36 layers",
    );
    is_rejected(
        &format!("({})", "9".repeat(38)),
        "layers must be at least 1 and at most 10^36, not 100000000000000000000000000000000000000",
    );
}

#[test]
fn an_overlong_text_is_not_parsed() {
    let letters = "c".repeat(LONGEST + 2);
    is_rejected(&letters, "is not a stacking of at most 4000000 characters");
}

#[test]
fn debug_output_shows_the_signs_of_up_to_65_layers() {
    for steps in [63, 64] {
        let shown = Stacking::fcc(steps + 1).unwrap().to_string();
        assert_eq!(shown, "+".repeat(usize::try_from(steps).unwrap()));
    }
    let stacking = Stacking::fcc(66).unwrap();
    assert_eq!(stacking.to_string(), "(65)");
    assert_eq!(stacking.mirrored().to_string(), "-(65)");
}
