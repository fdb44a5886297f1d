//! Every stacking of up to twelve steps in four notations, compared with a plain list of signs.

use cannonpile::lattice::Sign;
use cannonpile::stacking::{Notation, Run, Stacking};

use crate::lattice::each_signs;

/// The maximal number of steps.
const MOST: usize = 12;

/// The signs of a stacking, + as `true`.
struct Naive(Vec<bool>);

impl Naive {
    fn hagg(&self) -> String {
        let symbols = self.0.iter().map(|plus| if *plus { '+' } else { '-' });
        symbols.collect()
    }

    fn abc(&self) -> String {
        // A→B→C→A is +.
        let next = |letter: char, plus: bool| match (letter, plus) {
            ('A', true) | ('C', false) => 'B',
            ('B', true) | ('A', false) => 'C',
            _ => 'A',
        };
        let mut letters = vec!['A'];
        for (n, plus) in self.0.iter().enumerate() {
            letters.push(next(letters[n], *plus));
        }
        letters.into_iter().collect()
    }

    /// A letter for each inner layer: h at a sign change, c otherwise.
    fn jagodzinski(&self) -> String {
        let inner = self.0.windows(2);
        inner
            .map(|pair| if pair[0] == pair[1] { 'c' } else { 'h' })
            .collect()
    }

    fn zhdanov(&self) -> String {
        let runs = self.0.chunk_by(|a, b| a == b);
        let lengths: Vec<String> = runs.map(|run| run.len().to_string()).collect();
        format!("({})", lengths.join(","))
    }

    fn runs(&self) -> Vec<Run> {
        let runs = self.0.chunk_by(|a, b| a == b);
        runs.map(|run| Run {
            sign: sign(run[0]),
            steps: i128::try_from(run.len()).expect("short"),
        })
        .collect()
    }

    /// Makes + the first sign, because two notations omit it.
    fn plus_first(&self) -> Self {
        let first = self.0.first().copied().unwrap_or(true);
        Self(self.0.iter().map(|plus| *plus == first).collect())
    }
}

fn sign(plus: bool) -> Sign {
    if plus { Sign::Plus } else { Sign::Minus }
}

fn parsed(text: &str) -> Stacking {
    text.parse()
        .unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// The stacking has these signs, and all its accessors agree with them.
fn has_signs(stacking: &Stacking, naive: &Naive) {
    let signs: Vec<Sign> = naive.0.iter().map(|plus| sign(*plus)).collect();
    let runs = naive.runs();
    assert!(stacking.signs().eq(signs.iter().copied()), "{stacking:?}");
    assert_eq!(stacking.runs().collect::<Vec<_>>(), runs);
    assert_eq!(stacking.runs().len(), runs.len());
    assert!(stacking.runs().rev().eq(runs.iter().rev().copied()));
    let layers = i128::try_from(signs.len()).expect("short") + 1;
    assert_eq!(stacking.layers(), layers);
    let changes = naive.0.windows(2).filter(|pair| pair[0] != pair[1]).count();
    assert_eq!(stacking.changes(), changes);
    assert_eq!(stacking.is_straight(), changes == 0);
    assert_eq!(
        stacking.in_notation(Notation::Hagg).to_string(),
        naive.hagg()
    );
    assert_eq!(stacking.in_notation(Notation::Abc).to_string(), naive.abc());
    assert_eq!(
        stacking.in_notation(Notation::Jagodzinski).to_string(),
        naive.jagodzinski()
    );
    assert_eq!(
        stacking.in_notation(Notation::Zhdanov).to_string(),
        naive.zhdanov()
    );
}

/// Calls `visit` for all sequences of up to `MOST` steps.
fn each(mut visit: impl FnMut(&Naive, &Stacking)) {
    for steps in 0..=MOST {
        for signs in each_signs(steps) {
            let stacking = Stacking::from_signs(signs.iter().copied()).expect("short");
            let naive = Naive(signs.iter().map(|sign| *sign == Sign::Plus).collect());
            visit(&naive, &stacking);
        }
    }
}

#[test]
fn every_short_stacking_has_its_signs() {
    each(|naive, stacking| has_signs(stacking, naive));
}

#[test]
fn every_notation_is_read_back() {
    each(|naive, stacking| {
        let turned = naive.plus_first();
        if !naive.0.is_empty() {
            assert_eq!(parsed(&naive.hagg()), *stacking);
        }
        // At least one inner layer, because an empty text is invalid.
        if naive.0.len() > 1 {
            has_signs(&parsed(&naive.jagodzinski()), &turned);
        }
        assert_eq!(parsed(&naive.abc()), *stacking);
        has_signs(&parsed(&naive.zhdanov()), &turned);
    });
}

/// Converts from any of the four notations to any other.
#[test]
fn conversion_keeps_all_but_the_first_sign() {
    let shown = |stacking: &Stacking| {
        [
            stacking.in_notation(Notation::Hagg).to_string(),
            stacking.in_notation(Notation::Abc).to_string(),
            stacking.in_notation(Notation::Jagodzinski).to_string(),
            stacking.in_notation(Notation::Zhdanov).to_string(),
        ]
    };
    each(|naive, _| {
        if naive.0.len() < 2 || !naive.0[0] {
            return;
        }
        let want = shown(&parsed(&naive.hagg()));
        for text in &want {
            assert_eq!(shown(&parsed(text)), want, "by way of {text}");
        }
    });
}

/// The first letter of a text is arbitrary. The library prints A.
#[test]
fn any_first_letter_is_valid() {
    each(|naive, stacking| {
        let rename = |by: u8| -> String {
            let abc = naive.abc();
            let renamed = abc.bytes().map(|b| b'A' + (b - b'A' + by) % 3);
            renamed.map(char::from).collect()
        };
        for by in 0..3 {
            assert_eq!(parsed(&rename(by)), *stacking);
        }
    });
}

#[test]
fn mirrored_and_reversed() {
    each(|naive, stacking| {
        let mirrored = Naive(naive.0.iter().map(|plus| !plus).collect());
        let reversed = Naive(naive.0.iter().rev().copied().collect());
        has_signs(&stacking.mirrored(), &mirrored);
        has_signs(&stacking.reversed(), &reversed);
        assert_eq!(stacking.mirrored().mirrored(), *stacking);
        assert_eq!(stacking.reversed().reversed(), *stacking);
    });
}

/// Neighbouring runs of one sign are joined, and empty ones are dropped.
#[test]
fn runs_are_joined_and_dropped() {
    let run = |symbol: char, steps| Run {
        sign: sign(symbol == '+'),
        steps,
    };
    let cases: [(&[(char, i128)], &str); 9] = [
        (&[], ""),
        (&[('+', 0), ('-', 0)], ""),
        (&[('+', 2), ('+', 3)], "+++++"),
        (&[('-', 0), ('+', 1)], "+"),
        (&[('+', 0), ('-', 2), ('+', 0)], "--"),
        (&[('+', 1), ('-', 0), ('+', 1)], "++"),
        (&[('+', 1), ('-', 0), ('-', 1)], "+-"),
        (&[('-', 1), ('-', 0), ('-', 1), ('+', 1)], "--+"),
        (&[('+', 2), ('-', 1), ('-', 1), ('+', 0), ('-', 1)], "++---"),
    ];
    for (runs, signs) in cases {
        let made = Stacking::from_runs(runs.iter().map(|(symbol, steps)| run(*symbol, *steps)));
        let naive = Naive(signs.chars().map(|symbol| symbol == '+').collect());
        has_signs(&made.expect("few steps"), &naive);
    }
}

#[test]
fn named_stackings_are_periodic() {
    let periodic = |pattern: &str, layers: i128| {
        let signs = pattern.chars().cycle().map(|symbol| symbol == '+');
        let steps = usize::try_from(layers - 1).expect("few");
        Naive(signs.take(steps).collect())
    };
    for layers in 1..=40 {
        has_signs(&Stacking::fcc(layers).expect("few"), &periodic("+", layers));
        has_signs(
            &Stacking::hcp(layers).expect("few"),
            &periodic("+-", layers),
        );
        has_signs(
            &Stacking::dhcp(layers).expect("few"),
            &periodic("++--", layers),
        );
    }
    let texts = |stacking: Stacking| {
        (
            stacking.in_notation(Notation::Abc).to_string(),
            stacking.in_notation(Notation::Jagodzinski).to_string(),
        )
    };
    let of = |abc: &str, letters: &str| (abc.to_owned(), letters.to_owned());
    assert_eq!(
        texts(Stacking::fcc(7).expect("few")),
        of("ABCABCA", "ccccc")
    );
    assert_eq!(
        texts(Stacking::hcp(7).expect("few")),
        of("ABABABA", "hhhhh")
    );
    assert_eq!(
        texts(Stacking::dhcp(7).expect("few")),
        of("ABCBABC", "chchc")
    );
}

#[test]
fn one_layer() {
    for text in ["A", "B", "C", "()"] {
        assert_eq!(parsed(text), Stacking::single_layer());
    }
    assert_eq!(Stacking::fcc(1), Ok(Stacking::single_layer()));
    has_signs(&Stacking::single_layer(), &Naive(Vec::new()));
    assert_eq!(
        Stacking::single_layer()
            .in_notation(Notation::Abc)
            .to_string(),
        "A"
    );
    assert_eq!(
        Stacking::single_layer()
            .in_notation(Notation::Zhdanov)
            .to_string(),
        "()"
    );
    // Jagodzinski's letters begin with the second layer, so one letter stands for three layers.
    has_signs(&parsed("h"), &Naive(vec![true, false]));
    has_signs(&parsed("c"), &Naive(vec![true, true]));
}

/// The check rejects another stacking.
#[test]
fn a_wrong_sign_is_caught() {
    let stacking = parsed("++-+");
    has_signs(&stacking, &Naive(vec![true, true, false, true]));
    for wrong in [
        vec![true, true, false],
        vec![true, true, true, false],
        vec![false, false, true, false],
    ] {
        let caught = std::panic::catch_unwind(|| has_signs(&stacking, &Naive(wrong)));
        assert!(caught.is_err());
    }
}
