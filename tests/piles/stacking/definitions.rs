//! Stackings in the notations of the field, each from its definition, for every sequence up to 10 steps.

use cannonpile::stacking::{Notation, Stacking};

use cannonpile_testkit::cases::{all_signs, stacking};

/// A letter for each layer; A→B→C→A is +.
fn abc(signs: &str) -> String {
    let mut letter = 0;
    let mut text = String::from("A");
    for sign in signs.chars() {
        letter = (letter + if sign == '+' { 1 } else { 2 }) % 3;
        text.push(['A', 'B', 'C'][letter]);
    }
    text
}

/// A letter for each inner layer: h where the sign changes, c where it does not.
fn jagodzinski(signs: &str) -> String {
    let signs: Vec<char> = signs.chars().collect();
    let pairs = signs.windows(2);
    pairs
        .map(|pair| if pair[0] == pair[1] { 'c' } else { 'h' })
        .collect()
}

/// The lengths of the runs.
fn zhdanov(signs: &str) -> String {
    let mut lengths: Vec<usize> = Vec::new();
    let mut last = None;
    for sign in signs.chars() {
        match lengths.last_mut() {
            Some(length) if last == Some(sign) => *length += 1,
            _ => lengths.push(1),
        }
        last = Some(sign);
    }
    let lengths: Vec<String> = lengths.iter().map(ToString::to_string).collect();
    format!("({})", lengths.join(","))
}

#[test]
fn every_notation_is_written_by_its_definition_and_read_back() {
    for signs in (0..=10).flat_map(all_signs) {
        let it = stacking(&signs);
        let written = [
            it.in_notation(Notation::Hagg).to_string(),
            it.in_notation(Notation::Abc).to_string(),
            it.in_notation(Notation::Jagodzinski).to_string(),
            it.in_notation(Notation::Zhdanov).to_string(),
        ];
        let by_definition = [
            signs.clone(),
            abc(&signs),
            jagodzinski(&signs),
            zhdanov(&signs),
        ];
        assert_eq!(written, by_definition);
        let [hagg, abc, jagodzinski, zhdanov] = written.map(|text| text.parse::<Stacking>());
        // The last two do not say the first sign, and the first and third nothing of a single layer.
        let from_plus = if signs.starts_with('-') {
            it.mirrored()
        } else {
            it.clone()
        };
        assert_eq!(abc, Ok(it.clone()));
        assert_eq!(zhdanov, Ok(from_plus.clone()));
        if !signs.is_empty() {
            assert_eq!(hagg, Ok(it));
        }
        if signs.len() > 1 {
            assert_eq!(jagodzinski, Ok(from_plus));
        }
    }
}

#[test]
fn mirrored_and_reversed_are_what_they_are_of_the_signs() {
    for signs in (0..=10).flat_map(all_signs) {
        let it = stacking(&signs);
        let reversed: String = signs.chars().rev().collect();
        assert_eq!(it.reversed(), stacking(&reversed));
        let other = |sign| if sign == '+' { '-' } else { '+' };
        let mirrored: String = signs.chars().map(other).collect();
        // A stacking without a step has no sign to change.
        if !signs.is_empty() {
            assert_eq!(it.mirrored(), stacking(&mirrored));
        }
        let changes = signs
            .as_bytes()
            .windows(2)
            .filter(|pair| pair[0] != pair[1]);
        let changes = changes.count();
        assert_eq!((it.changes(), it.is_straight()), (changes, changes == 0));
        assert_eq!(it.layers(), i128::try_from(signs.len() + 1).unwrap());
        assert!(
            it.signs()
                .map(cannonpile::lattice::Sign::symbol)
                .eq(signs.chars())
        );
    }
}

#[test]
fn the_named_stackings_repeat_their_periods() {
    for layers in 1..30_usize {
        let given = i128::try_from(layers).unwrap();
        let named = [
            Stacking::fcc(given),
            Stacking::hcp(given),
            Stacking::dhcp(given),
        ];
        let periods = ["+", "+-", "++--"]
            .map(|period| cannonpile_testkit::cases::repeated(period, layers - 1));
        assert_eq!(
            named.map(Result::unwrap),
            periods.map(|signs| stacking(&signs))
        );
    }
}

#[test]
fn single_layers_are_one_stacking() {
    assert_eq!(stacking(""), Stacking::single_layer());
    assert_eq!(Stacking::fcc(1), Ok(Stacking::single_layer()));
    assert_eq!(stacking("-").reversed().reversed(), stacking("-"));
}
