//! Records with an altered number are refused.

use cannonpile::lattice::Region;
use cannonpile_disorder::{
    Choice, Ensemble, FirstSign, RandomStackings, Samples, Shard, TallyRecord,
};
use num_bigint::BigInt;
use num_traits::Zero;

use cannonpile_testkit::answers::ratio;

/// Returns parts of ensembles: with samples and without, with loads, wide bins, and counts of horizontal contacts.
fn parts() -> Vec<String> {
    let under = |top, layers, first| {
        Ensemble::under(top, RandomStackings::new(layers, first).unwrap()).unwrap()
    };
    let triangle = Region::triangle(2).unwrap();
    let loaded = under(Region::SITE, 5, FirstSign::Random);
    let loaded = loaded.with_load([0, 0], ratio(2, 3)).unwrap();
    let wide = under(Region::SITE, 6, FirstSign::Plus);
    let wide = wide.with_bin_width(ratio(5, 2)).unwrap();
    let touching = under(Region::SITE, 5, FirstSign::Plus);
    let touching = touching.with_horizontal_contacts().unwrap();
    let base = Region::hexagon(2, 3).unwrap();
    let stackings = RandomStackings::new(4, FirstSign::Random).unwrap();
    let on_base = Ensemble::on(base, stackings).unwrap();
    let drawn = Choice::Drawn(Samples::new(30, 7, ratio(1, 3)).unwrap());
    let runs = [
        (under(Region::SITE, 6, FirstSign::Plus), Choice::All),
        (under(triangle, 4, FirstSign::Minus), Choice::All),
        (loaded, Choice::All),
        (wide, drawn.clone()),
        (under(Region::SITE, 7, FirstSign::Plus), drawn),
        (touching, Choice::All),
        (on_base, Choice::All),
    ];
    let shards = [Shard::WHOLE, shard(1), shard(2)];
    let runs = runs
        .iter()
        .flat_map(|run| shards.iter().map(move |shard| (run, *shard)));
    runs.map(|((ensemble, choice), shard)| {
        let judge = |_: &cannonpile::Pile| Ok::<_, cannonpile_disorder::Error>(false);
        let tally = ensemble.run_judged(choice, shard, &|_| {}, &judge).unwrap();
        let mut text = Vec::new();
        let record = TallyRecord::new(tally, ratio(1, 2)).unwrap();
        record.write(&mut text).unwrap();
        String::from_utf8(text).unwrap()
    })
    .collect()
}

fn shard(index: u64) -> Shard {
    Shard::new(index, 2).unwrap()
}

/// Returns the text with each run of digits replaced by other numbers, one at a time.
fn altered(text: &str) -> impl Iterator<Item = String> {
    let is_digit = |at: usize| text.as_bytes().get(at).is_some_and(u8::is_ascii_digit);
    let starts = (0..text.len()).filter(move |at| is_digit(*at) && (*at == 0 || !is_digit(at - 1)));
    starts.flat_map(move |start| {
        let end = (start..text.len())
            .find(|at| !is_digit(*at))
            .unwrap_or(text.len());
        let number: BigInt = text[start..end].parse().unwrap();
        let others = [
            &number + 1,
            &number - 1,
            -&number,
            &number * 3 + 2,
            BigInt::zero(),
        ];
        let others = others.into_iter().filter(move |other| *other != number);
        others.map(move |other| format!("{}{other}{}", &text[..start], &text[end..]))
    })
}

#[test]
fn no_altered_number_is_accepted() {
    let mut count = 0;
    for text in parts() {
        TallyRecord::read(text.as_bytes()).unwrap();
        for altered in altered(&text) {
            count += 1;
            assert!(
                TallyRecord::read(altered.as_bytes()).is_err(),
                "{altered}\n{text}"
            );
        }
    }
    assert!(count > 10_000, "{count}");
}

#[test]
fn a_record_without_digest_is_refused() {
    let text = &parts()[0];
    let (entries, _) = text.rsplit_once(",\n  \"sha256\"").unwrap();
    let refused = TallyRecord::read(format!("{entries}\n}}\n").as_bytes()).unwrap_err();
    assert!(refused.to_string().contains("no digest"), "{refused}");
}
