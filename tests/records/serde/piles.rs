//! Piles are stored by their parts.

use cannonpile::lattice::{MAX_LAYERS, Region, Site};
use cannonpile::{Load, Pile};
use num_rational::BigRational;

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::json::back;

#[test]
fn piles() {
    let apex = Site::APEX;
    let low = Site { i: 1, j: 0, k: 3 };
    for pile in [
        Pile::triangular(1),
        Pile::isosceles(1, ratio(1, 3)),
        Pile::discs(1),
        Pile::under(Region::hexagon(2, 1).unwrap(), "A".parse().unwrap()),
        Pile::on(Region::hexagon(2, 1).unwrap(), "A".parse().unwrap()),
        Pile::triangular(10),
        Pile::triangular(MAX_LAYERS),
        Pile::isosceles(4, ratio(1, 3)),
        Pile::discs(5),
        Pile::under(Region::SITE, "-".parse().unwrap()),
        Pile::under(Region::hexagon(3, 2).unwrap(), "+-++".parse().unwrap()),
        Pile::on(Region::hexagon(5, 4).unwrap(), "+-++".parse().unwrap()),
        Pile::on(Region::triangle(4).unwrap(), "+++".parse().unwrap()),
    ] {
        let pile = pile.unwrap();
        back(&pile);
        let site = if pile.shape().contains(low) {
            low
        } else {
            pile.shape().sites().next().unwrap()
        };
        let loaded = pile
            .clone()
            .with_load(site, ratio(5, 2))
            .and_then(|pile| pile.with_weight(site, ratio(0, 1)))
            .unwrap();
        back(&loaded);
        assert_ne!(loaded, pile);
        back(&loaded.weightless());
    }
    let pile = Pile::discs(2)
        .unwrap()
        .with_load(apex, ratio(1, 3))
        .unwrap();
    assert_eq!(
        back(&pile),
        r#"{"dimension":2,"sin_phi":"0","stacking":"+","anchor":{"top":"hexagon:1"},"weightless":false,"#.to_owned()
            + r#""tilt":{"x":"0","y":"0"},"weights":[],"#
            + r#""loads":[{"site":{"i":0,"j":0,"k":0},"weight":"1/3","x":"0","y":"0"}],"horizontal":[]}"#
    );
}

/// Each number of a pile is written in lowest terms, also if a caller made it otherwise.
#[test]
fn raw_ratios_are_written_in_lowest_terms() {
    let raw = |n: i64, d: i64| BigRational::new_raw(n.into(), d.into());
    let pile = Pile::isosceles(3, raw(-3, -5)).unwrap();
    let load = Load {
        down: raw(-2, -4),
        x: raw(-3, 6),
        y: raw(0, -1),
    };
    let pile = pile
        .with_tilt([raw(6, -9), raw(-6, 9)])
        .and_then(|pile| pile.with_weight(Site::APEX, raw(-7, -14)))
        .and_then(|pile| pile.with_load(Site::new(0, 0, 1), load))
        .unwrap();
    let text = back(&pile);
    for part in [
        r#""sin_phi":"3/5""#,
        r#""tilt":{"x":"-2/3","y":"-2/3"}"#,
        r#""weight":"1/2""#,
        r#""weight":"1/2","x":"-1/2","y":"0""#,
    ] {
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn invalid_piles_are_rejected() {
    let text = |dimension: u8, sin_phi: &str, stacking: &str, anchor: &str, loads: &str| {
        format!(
            r#"{{"dimension":{dimension},"sin_phi":"{sin_phi}","stacking":"{stacking}","anchor":{anchor},"#
        ) + &format!(r#""weightless":false,"weights":[],"loads":{loads}}}"#)
    };
    let (site, base) = (r#"{"top":"hexagon:1"}"#, r#"{"base":"triangle:3"}"#);
    let load = |k: i128, weight: &str| {
        format!(r#"[{{"site":{{"i":"0","j":"0","k":"{k}"}},"weight":"{weight}"}}]"#)
    };
    let read = |text: &str| serde_json::from_str::<Pile>(text);
    read(&text(3, "1/2", "++", base, &load(2, "1"))).expect("a pile");
    for (text, part) in [
        (text(3, "1/2", "+++", base, "[]"), "at most 3"),
        (text(3, "1/3", "+-", site, "[]"), "sin-phi"),
        (text(3, "1/3", "++", base, "[]"), "sin-phi"),
        (text(3, "1", "++", site, "[]"), "between 0 and 1"),
        (text(2, "1/2", "++", site, "[]"), "sin-phi"),
        (
            text(2, "0", "+-", site, "[]"),
            "stacking has no meaning with dimension 2",
        ),
        (text(2, "0", "++", base, "[]"), "no meaning with"),
        (text(3, "1/2", "++", base, &load(3, "1")), "no layer 3"),
        (
            text(3, "1/2", "++", base, &load(2, "-1")),
            "must not be negative",
        ),
        (
            text(3, "1/2", "++", base, &load(2, "1/0")),
            "other than zero",
        ),
    ] {
        let error = read(&text).expect_err(&text).to_string();
        assert!(error.contains(part), "{text}: no '{part}' in {error}");
    }
    let weight = r#"{"site":{"i":"0","j":"0","k":"1"},"weight":"2"}"#;
    let weights = |list: &str| {
        let weights = format!(r#""weights":[{list}]"#);
        text(3, "1/2", "++", site, "[]").replace(r#""weights":[]"#, &weights)
    };
    read(&weights(weight)).expect("a pile");
    let error = read(&weights(&format!("{weight},{weight}"))).expect_err("two weights");
    assert!(
        error
            .to_string()
            .contains("two weights of the sphere (i,j,k) = (0,0,1)")
    );
    // A text that is cut off or has a changed byte yields an error or a pile that can be written.
    let pile = Pile::under(Region::hexagon(3, 2).unwrap(), "+-++".parse().unwrap());
    let pile = pile
        .and_then(|pile| pile.with_load(Site::APEX, ratio(7, 3)))
        .unwrap();
    let bytes = postcard::to_allocvec(&pile).unwrap();
    for place in 0..bytes.len() {
        assert!(postcard::from_bytes::<Pile>(&bytes[..place]).is_err());
        for byte in 0..=u8::MAX {
            let mut bytes = bytes.clone();
            bytes[place] = byte;
            if let Ok(pile) = postcard::from_bytes::<Pile>(&bytes) {
                back(&pile);
            }
        }
    }
    // The binary format too: the sign of a load is its first character.
    let pile = Pile::triangular(2)
        .unwrap()
        .with_load(Site::APEX, ratio(7, 1))
        .unwrap();
    let mut bytes = postcard::to_allocvec(&pile).unwrap();
    *bytes.last_mut().unwrap() = b'x';
    assert!(postcard::from_bytes::<Pile>(&bytes).is_err());
}
