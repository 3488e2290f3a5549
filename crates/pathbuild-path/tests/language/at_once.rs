//! Tests the messages for drawings with two mistakes. (book: reference/diagnostics)

use crate::support::wrong;

/// The lines of a correct drawing, which mistakes replace.
#[derive(Clone)]
struct Lines {
    start: String,
    hole: &'static str,
    groove: String,
    link: &'static str,
    outline: &'static str,
    end: &'static str,
    more: Vec<&'static str>,
}

struct Mistake {
    name: &'static str,
    make: fn(&mut Lines),
    code: &'static str,
}

const MISTAKES: [Mistake; 14] = [
    Mistake { name: "O missing", make: |it| it.start = it.start.replace("O3 ", ""), code: "PB201 O" },
    Mistake { name: "unit", make: |it| it.start = it.start.replace("T4", "T4mm"), code: "PB205 T" },
    Mistake { name: "lower case", make: |it| it.groove = it.groove.replace('B', "b"), code: "PB202 b" },
    Mistake { name: "gap", make: |it| it.groove = it.groove.replace("20,20", "20.5,20"), code: "PB401" },
    Mistake { name: "hole too small", make: |it| it.hole = "circle CONTINUOUS 10,10 d 2.9", code: "PB109" },
    Mistake { name: "twice in a text", make: |it| it.link = "sweep 40,20 60,20 \"S9 S9\"", code: "PB204 S" },
    Mistake {
        name: "unknown line type",
        make: |it| it.outline = "line \"ZIGZAG\" 60,20 60,60",
        code: "PB106",
    },
    Mistake { name: "no end", make: |it| it.end = "", code: "PB102" },
    Mistake { name: "end elsewhere", make: |it| it.end = "end 90,90", code: "PB403" },
    Mistake { name: "second end", make: |it| it.more.push("end 0,90"), code: "PB104" },
    Mistake { name: "left over", make: |it| it.more.push("mill 80,80 90,80"), code: "PB402" },
    Mistake { name: "stray text", make: |it| it.more.push("text 95,10 \"I1\""), code: "PB107" },
    Mistake { name: "odd circle", make: |it| it.more.push("circle PHANTOM 70,80 d 3"), code: "PB105" },
    Mistake {
        name: "no variable",
        make: |it| it.more.push("sweep 60,60 70,60 \"S=X\"\nsweep 70,60 60,60"),
        code: "PB303",
    },
];

/// Pairs of mistakes with the codes that are reported: one mistake hides the other, or the two together look like another mistake.
const TOGETHER: [([&str; 2], &[&str]); 7] = [
    // Without O, it is unknown which circle is too small.
    (["O missing", "hole too small"], &["PB201 O"]),
    // The only end that is left is in the wrong place, or there is none.
    (["no end", "second end"], &["PB403"]),
    (["no end", "end elsewhere"], &["PB102"]),
    // Without an end, the path breaks off at the remaining segments.
    (["no end", "left over"], &["PB102", "PB401"]),
    (["end elsewhere", "left over"], &["PB401"]),
    // The correct end is unknown.
    (["end elsewhere", "second end"], &["PB104"]),
    (["second end", "left over"], &["PB104"]),
];

fn drawing(mistakes: &[&Mistake]) -> String {
    let mut lines = Lines {
        start: "start 0,0 \"O3 T4 I1 F200 B-0.3\"".to_owned(),
        hole: "circle CONTINUOUS 10,10 d 3",
        groove: "mill 20,20 40,20 \"B2\"".to_owned(),
        link: "sweep 40,20 60,20",
        outline: "mill 60,20 60,60",
        end: "end 60,60",
        more: Vec::new(),
    };
    for mistake in mistakes {
        (mistake.make)(&mut lines);
    }
    let Lines { start, hole, groove, link, outline, end, more } = lines;
    let more = more.join("\n");
    format!(
        "layer 1234.1P\n{start}\nsweep 0,0 10,10\n{hole}\nsweep 10,10 20,20\n{groove}\n{link}\n{outline}\n{end}\n{more}"
    )
}

fn expected(pair: [&Mistake; 2]) -> Vec<&'static str> {
    let is_pair =
        |names: &[&str; 2]| *names == [pair[0].name, pair[1].name] || *names == [pair[1].name, pair[0].name];
    let together = TOGETHER.iter().find(|(names, _)| is_pair(names));
    together.map_or_else(|| pair.map(|mistake| mistake.code).to_vec(), |(_, codes)| codes.to_vec())
}

#[test]
fn each_pair_of_mistakes_gives_its_messages() {
    assert_eq!(wrong(&drawing(&[])), [""; 0]);
    let mut different = Vec::new();
    for (number, one) in MISTAKES.iter().enumerate() {
        assert_eq!(wrong(&drawing(&[one])), [one.code], "{}", one.name);
        for other in &MISTAKES[..number] {
            let (mut found, mut wanted) = (wrong(&drawing(&[one, other])), expected([one, other]));
            found.sort();
            wanted.sort_unstable();
            if found != wanted {
                different.push(format!("{} and {}: {found:?}, not {wanted:?}", one.name, other.name));
            }
        }
    }
    assert!(different.is_empty(), "{}", different.join("\n"));
}

#[test]
fn a_text_at_fault_makes_its_own_letters_unknown() {
    let with = |groove: &str| {
        wrong(&format!("layer 1234.1P\nstart 0,0 \"O3 T4 I1\"\nmill 0,0 40,0 {groove}\nend 40,0"))
    };
    assert_eq!(with(""), ["PB201 B"]);
    assert_eq!(with("\"b2\""), ["PB202 b"]);
    assert_eq!(with("\"2\""), ["PB202 2"]);
    // X is the letter of no parameter.
    assert_eq!(with("\"X2\""), ["PB202 X", "PB201 B"]);
    assert_eq!(with("\"B 2\""), ["PB202"]);
    assert_eq!(with("\"B2mm\""), ["PB205 B"]);
    assert_eq!(with("\"F100\""), ["PB201 B"]);
    assert_eq!(with("\"f100\""), ["PB202 f", "PB201 B"]);
    assert_eq!(with("\ntext 90,90 \"B2\""), ["PB107"]);
    assert_eq!(with("\ntext 90,90 \"F200\""), ["PB107", "PB201 B"]);
}
