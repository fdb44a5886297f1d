//! Certificates as JSON: the format, and invalid input that is rejected.

use cannonpile::Pile;
use cannonpile::lattice::{Axis, HorizontalContact, Region, Site};
use cannonpile_horizontal::certificate::{
    Certificate, Claim, Extreme, read_certificate, write_certificate,
};
use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::json::{back, refusal};

fn certificate(claim: Claim) -> Certificate {
    let site = Site { i: 0, j: -1, k: 1 };
    let pile = Pile::under(Region::hexagon(2, 2).unwrap(), "+-".parse().unwrap()).unwrap();
    let contact = |axis| HorizontalContact { site, axis };
    Certificate {
        pile,
        claim,
        horizontal: [
            (contact(Axis::AlphaBeta), ratio(1, 2)),
            (contact(Axis::GammaBeta), ratio(0, 1)),
        ]
        .into(),
        field: [
            (Site::APEX, [ratio(0, 1), ratio(-1, 1), ratio(1, 3)]),
            (site, [ratio(-7, 3), ratio(10_i64.pow(18), 1), ratio(1, 1)]),
        ]
        .into(),
    }
}

fn claims() -> [(Claim, &'static str); 5] {
    let extreme = |attained| Extreme {
        site: Site { i: 0, j: 0, k: 2 },
        normal: ratio(7, 3),
        attained,
    };
    let stiffness_ratio = ratio(1, 2);
    let site = r#"{"site":{"i":0,"j":0,"k":2},"normal":"7/3","attained":"#;
    let least = format!(r#"{{"least":{site}true}}}}"#);
    let greatest = format!(r#"{{"greatest":{site}false}}}}"#);
    [
        (Claim::Stands, r#""stands""#),
        (Claim::CannotStand, r#""cannot-stand""#),
        (Claim::Least(extreme(true)), least.leak()),
        (Claim::Greatest(extreme(false)), greatest.leak()),
        (
            Claim::Elastic { stiffness_ratio },
            r#"{"elastic":{"stiffness_ratio":"1/2"}}"#,
        ),
    ]
}

#[test]
fn certificates() {
    for (claim, text) in claims() {
        assert_eq!(back(&claim), text);
        let certificate = certificate(claim);
        back(&certificate);
        let mut file = Vec::new();
        write_certificate(&certificate, &mut file).unwrap();
        assert_eq!(read_certificate(&*file).unwrap(), certificate);
        let same: Certificate = serde_json::from_slice(&file).unwrap();
        assert_eq!(same, certificate);
    }
    let written = back(&certificate(Claim::Stands));
    let lists = r#""claim":"stands","horizontal":[{"site":{"i":0,"j":-1,"k":1},"axis":"alpha-beta","force":"1/2"},"#
        .to_owned()
        + r#"{"site":{"i":0,"j":-1,"k":1},"axis":"gamma-beta","force":"0"}],"#
        + r#""field":[{"site":{"i":0,"j":0,"k":0},"alpha":"0","beta":"-1","gamma":"1/3"},"#
        + r#"{"site":{"i":0,"j":-1,"k":1},"alpha":"-7/3","beta":"1000000000000000000","gamma":"1"}]}"#;
    let (pile, after) = written.split_at(written.len() - lists.len());
    assert_eq!(after, lists);
    assert!(
        pile.starts_with(r#"{"pile":{"dimension":3,"sin_phi":"1/2","stacking":"+-","#),
        "{pile}"
    );
}

#[test]
fn invalid_certificates_are_rejected() {
    let text = serde_json::to_string(&certificate(Claim::Stands)).unwrap();
    for (from, to, said) in [
        (
            "alpha-beta",
            "gamma-beta",
            "two forces of the horizontal contact (0,-1,1) gamma-beta: leave one",
        ),
        (
            r#""i":0,"j":0,"k":0"#,
            r#""i":0,"j":-1,"k":1"#,
            "two values of the field on the sphere (i,j,k) = (0,-1,1): leave one",
        ),
        (
            "alpha-beta",
            "beta-alpha",
            "alpha-beta, alpha-gamma or gamma-beta",
        ),
        ("\"1/2\"}", "\"1/0\"}", "other than zero"),
        ("\"1/3\"", "0.3", "a string"),
        (r#","gamma":"1/3""#, "", "missing field `gamma`"),
        (
            r#","gamma":"1/3""#,
            r#","gamma":"1/3","delta":"0""#,
            "`delta`",
        ),
        (
            r#""force":"1/2""#,
            r#""force":"1/2","force":"1/2""#,
            "duplicate field `force`",
        ),
        (r#","field":"#, r#","fields":"#, "`fields`"),
        (r#""claim":"stands","#, "", "missing field `claim`"),
        (r#""stands""#, r#""stand""#, "`stand`"),
        (
            r#""stands""#,
            r#"{"elastic":{"stiffness_ratio":"1","k":1}}"#,
            "`k`",
        ),
        (
            r#""stands""#,
            r#"{"least":{"site":{"i":0,"j":0,"k":2},"normal":"1"}}"#,
            "`attained`",
        ),
        (r#""stacking":"+-""#, r#""stacking":"+*""#, "such as ++-+"),
        (
            r#""horizontal":["#,
            r#""horizontal":{"a":["#,
            "expected a list",
        ),
    ] {
        let changed = text.replacen(from, to, 1);
        assert_ne!(changed, text, "{from}");
        let error = refusal::<Certificate>(&changed);
        assert!(
            error.contains(said),
            "{from} -> {to}: no '{said}' in {error}"
        );
        let from_file = read_certificate(changed.as_bytes()).unwrap_err();
        assert_eq!(from_file.kind(), std::io::ErrorKind::InvalidData);
        assert!(from_file.to_string().contains(said), "{from_file}");
    }
    // Trailing and missing input is rejected.
    assert!(read_certificate(format!("{text} {{}}").as_bytes()).is_err());
    for end in 0..text.len() {
        let error = read_certificate(&text.as_bytes()[..end]).unwrap_err();
        assert_eq!(error.kind(), std::io::ErrorKind::UnexpectedEof, "{end}");
    }
    // The same for a binary format.
    let bytes = postcard::to_allocvec(&certificate(Claim::Stands)).unwrap();
    for place in 0..bytes.len() {
        assert!(postcard::from_bytes::<Certificate>(&bytes[..place]).is_err());
        for byte in [0, 1, b'0', b'-', 0x7f, 0xff] {
            let mut bytes = bytes.clone();
            bytes[place] = byte;
            if let Ok(certificate) = postcard::from_bytes::<Certificate>(&bytes) {
                back(&certificate);
            }
        }
    }
}

#[test]
fn certificate_pile_has_no_horizontal_forces() {
    let region = Region::hexagon(2, 2).unwrap();
    let pile = Pile::under(region, "+-++-".parse().unwrap()).unwrap();
    let contact = HorizontalContact {
        site: Site { i: 0, j: 1, k: 2 },
        axis: Axis::GammaBeta,
    };
    let pushed = pile.clone().with_horizontal_force(contact, ratio(2, 7));
    let pushed = pushed.unwrap();
    let certificate = cannonpile_horizontal::equilibrium(&pushed).unwrap();
    assert_eq!(certificate.pile, pile);
    let text = serde_json::to_string(&Certificate {
        pile: pushed,
        ..certificate
    })
    .unwrap();
    assert!(refusal::<Certificate>(&text).contains("has horizontal forces"));
}
