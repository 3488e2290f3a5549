//! Tests variables. (book: language/variables)

use pathbuild_diagnostic::Lang;
use pathbuild_path::{Bindings, Definition};

use crate::support::{codes, compile_raw, language, path, raw, read, wrong};

fn definition(text: &str) -> Definition {
    Definition::parse(text).unwrap_or_else(|problem| panic!("{text}: {problem:?}"))
}

fn allowed<'a>(text: &str, values: &[&'a str]) -> Vec<&'a str> {
    let definition = definition(text);
    values.iter().copied().filter(|value| definition.allows(value)).collect()
}

fn is_wrong(text: &str) -> bool {
    Definition::parse(text).is_err_and(|problem| codes(&[*problem]) == ["PB301"])
}

#[test]
fn a_range_allows_both_ends_and_what_is_between() {
    let values = ["-0.5", "-0,5", "0", "1.2", "1.1999999", "-0.51", "1.21", "x", ""];
    assert_eq!(allowed("x-0.5~1,2", &values), ["-0.5", "-0,5", "0", "1.2", "1.1999999"]);
    assert_eq!(allowed("x2~2", &["2", "2.1"]), ["2"]);
    // Numbers are compared approximately, as everywhere.
    assert_eq!(allowed("x1~2", &["2.000001", "2.00001"]), ["2.000001"]);
}

#[test]
fn a_range_is_the_right_way_round() {
    assert!(is_wrong("x2~1"));
    assert!(!is_wrong("x1~2"));
    assert!(is_wrong("x2~1,9"));
}

/// With decimal commas, the text could also be a list, but it is first tried as a range.
#[test]
fn a_range_comes_before_a_list() {
    assert_eq!(allowed("x-0,5~0,4", &["0", "-0,5", "5~0"]), ["0", "-0,5"]);
    assert_eq!(allowed("x1~a,2", &["1~a", "2", "1.5"]), ["1~a", "2"]);
}

#[test]
fn a_list_allows_its_texts_exactly() {
    assert_eq!(allowed("xP1,P2,P3", &["P1", "P3", "p1", "P", "P1,P2", ""]), ["P1", "P3"]);
    // Values of a list are compared as texts, so 1.0 is not 1.
    assert_eq!(allowed("x1,2", &["1", "1.0"]), ["1"]);
    assert_eq!(allowed("x?P1,?P2", &["P1", "?P1", "P2"]), ["P1", "P2"]);
    assert_eq!(allowed("xa\u{a0},\u{a0}b", &["a", "b"]), ["a", "b"]);
    assert!(is_wrong("xP1,,P3"));
    assert!(is_wrong("xP1,"));
    assert!(is_wrong("x,"));
    assert!(is_wrong("x?,P1"));
}

#[test]
fn a_question_mark_allows_single_characters() {
    assert_eq!(allowed("x?PQß", &["P", "ß", "PQ", "p", "?", ""]), ["P", "ß"]);
    assert!(is_wrong("x?"));
}

#[test]
fn anything_else_is_no_definition() {
    for text in ["x", "", "xP1", "x1", "x1~", "x~1", "xa~b", "x1;2"] {
        assert!(is_wrong(text), "{text}");
    }
}

#[test]
fn a_wrong_definition_is_reported_at_the_start() {
    let with =
        |definition: &str| wrong(&path(&format!("T5 O3 I1 B0 {definition}"), "mill 0,0 40,0\nend 40,0"));
    assert_eq!(with(":x1~2"), ["PB210"]);
    assert_eq!(with(":x1"), ["PB301"]);
    assert_eq!(with(":"), ["PB301"]);
}

/// k is the index of the variable among all of them, from 0, in the order in which they are written.
#[test]
fn check_values_are_examples_of_each_definition() {
    let values = |definitions: &str| {
        let raw = raw(&path(&format!("T5 O3 I1 B0 {definitions}"), "mill 0,0 40,0\nend 40,0"));
        Bindings::check_values(&raw.definitions)
            .iter()
            .map(|(name, value)| format!("{name}={value}"))
            .collect::<Vec<_>>()
    };
    assert_eq!(values(":a1~2,5 :b1~2,5 :c1~2,5"), ["a=1", "b=2,5", "c=1"]);
    assert_eq!(values(":cP,Q :aP,Q :bP,Q"), ["a=Q", "b=P", "c=P"]);
    assert_eq!(values(":a?xyz :b?xyz :c?xyz :d?xyz"), ["a=x", "b=y", "c=z", "d=x"]);
    assert_eq!(values(":a1~2 :bP,Q,R :c?xyz"), ["a=1", "b=Q", "c=z"]);
    assert_eq!(values(""), [""; 0]);
}

#[test]
fn corner_values_are_all_of_a_list_and_the_ends_of_a_range() {
    assert_eq!(definition("a1~2,5").corner_values(), ["1", "2,5"]);
    assert_eq!(definition("aP,Q,R").corner_values(), ["P", "Q", "R"]);
    assert_eq!(definition("a?xy").corner_values(), ["x", "y"]);
}

/// Compiles a path with a text on its line and values for its variables.
fn bound(text: &str, values: &[(char, &str)]) -> crate::support::Compiled {
    let definitions: Vec<String> = values.iter().map(|(name, _)| format!(":{name}1~2")).collect();
    let raw = raw(&path(
        &format!("T5 O3 I1 B0 {}", definitions.join(" ")),
        &format!("mill 0,0 40,0 \"{text}\"\nend 40,0"),
    ));
    let bindings = Bindings::new(values.iter().map(|(name, value)| (*name, (*value).into())));
    compile_raw(&raw, &bindings, &language())
}

/// Returns the value of Q, or the codes of the findings.
fn filled(text: &str, values: &[(char, &str)]) -> String {
    let compiled = bound(&format!("Q{text}"), values);
    if let Some(path) = compiled.path {
        return path.cuts[0].comment.clone().unwrap().into();
    }
    let found = codes(&compiled.found);
    found.into_iter().filter(|code| code != "PB210").collect::<Vec<_>>().join(" ")
}

#[test]
fn references_are_replaced_wherever_they_stand() {
    assert_eq!(filled("=a", &[('a', "x")]), "x");
    assert_eq!(filled("2051.=aP=a=b", &[('a', "3"), ('b', "4")]), "2051.3P34");
    assert_eq!(filled("=ab", &[('a', "x")]), "xb");
    assert_eq!(filled("plain", &[('a', "x")]), "plain");
}

#[test]
fn values_may_contain_references() {
    assert_eq!(filled("=a", &[('a', "<=b>"), ('b', "<=c>"), ('c', "x")]), "<<x>>");
    assert_eq!(filled("=a=a", &[('a', "=b=b"), ('b', "x")]), "xxxx");
}

#[test]
fn a_value_that_leads_back_to_itself_is_an_error() {
    assert_eq!(filled("=a", &[('a', "=a")]), "PB305");
    assert_eq!(filled("=a", &[('a', "=b"), ('b', "=c"), ('c', "=a")]), "PB305");
    assert_eq!(filled("=a", &[('a', "=b"), ('b', "=c"), ('c', "x")]), "x");
}

/// Returns a chain of variables, each defined by the next one; the last one is `x`.
fn chained(count: u32) -> String {
    let names: Vec<char> = (0..count).filter_map(|index| char::from_u32(0x4e00 + index)).collect();
    let mut values: Vec<(char, String)> =
        names.windows(2).map(|pair| (pair[0], format!("={}", pair[1]))).collect();
    values.extend(names.last().map(|last| (*last, "x".to_owned())));
    let values: Vec<(char, &str)> = values.iter().map(|(name, value)| (*name, value.as_str())).collect();
    filled(&format!("={}", names[0]), &values)
}

/// Thousands of variables that refer to each other would require a pass each.
#[test]
fn values_refer_to_others_up_to_a_depth() {
    assert_eq!((chained(65), chained(66)), ("x".to_owned(), "PB305".to_owned()));
}

#[test]
fn a_reference_to_nothing_is_an_error() {
    assert_eq!(filled("=x", &[('a', "1")]), "PB303");
    assert_eq!(filled("=", &[('a', "1")]), "PB303");
    assert_eq!(filled("=a", &[('a', "=x")]), "PB303");
    assert_eq!(filled("=A", &[('a', "1")]), "PB303");
}

/// The text of variables doubles in each pass.
#[test]
fn a_text_does_not_grow_beyond_the_limit() {
    let double: Vec<(char, String)> =
        ('a'..='y').map(|name| (name, format!("={0}={0}", char::from(name as u8 + 1)))).collect();
    let mut values: Vec<(char, &str)> = double.iter().map(|(name, value)| (*name, value.as_str())).collect();
    values.push(('z', "x"));
    assert_eq!(filled("=a", &values), "PB005");
    // Ten levels give 512 letters.
    assert_eq!(filled("=q", &values).len(), 512);
}

#[test]
fn a_filled_value_is_checked_like_any_other() {
    let codes_of = |text: &str, value: &str| codes(&bound(text, &[('a', value)]).found);
    assert_eq!(codes_of("B=a", "1"), [""; 0]);
    assert_eq!(codes_of("B=a", "x"), ["PB205 B"]);
    assert_eq!(codes_of("B=a", "5"), ["PB203 B"]);
}

/// References are not substituted in definitions, although they may contain "=": `:a=b,=c` is a list of two references.
#[test]
fn definitions_are_not_filled_in() {
    assert_eq!(definition("a=b,=c").corner_values(), ["=b", "=c"]);
    assert_eq!(wrong(&path("T5 O3 I1 B0 :a=b,=c :b1~2 :c1~2", "mill 0,0 40,0 \"B=a\"\nend 40,0")), [""; 0]);
}

#[test]
fn a_path_is_not_emitted_without_values_of_its_variables() {
    let raw = raw(&path("T5 O3 I1 B0 :a1~2 :b1~2", "mill 0,0 40,0\nend 40,0"));
    let missing = |values: &[(char, &str)]| {
        codes(
            &raw.missing_values(&Bindings::new(values.iter().map(|(name, value)| (*name, (*value).into())))),
        )
    };
    assert_eq!(missing(&[('a', "1"), ('b', "1")]), [""; 0]);
    assert_eq!(missing(&[('a', "1")]), ["PB302"]);
    assert_eq!(missing(&[]), ["PB302", "PB302"]);
}

#[test]
fn bindings_compare_without_order() {
    let bindings =
        |values: [(char, &str); 2]| Bindings::new(values.map(|(name, value)| (name, value.into())));
    assert_eq!(bindings([('a', "1"), ('b', "2")]), bindings([('b', "2"), ('a', "1")]));
    assert_ne!(bindings([('a', "1"), ('b', "2")]), bindings([('a', "2"), ('b', "1")]));
}

/// `0,5,0,8` was probably meant to be 0.5 and 0.8.
#[test]
fn a_value_that_is_listed_twice_is_reported() {
    let found = |start: &str| {
        let raw = raw(&path(&format!("T5 O3 I1 {start}"), "mill 0,0 40,0 \"B=D\"\nend 40,0"));
        raw.diagnostics.iter().map(|found| found.text(Lang::En)).collect::<Vec<_>>()
    };
    assert_eq!(found(":D0,5,0,8"), ["the values of variable \"D\" contain \"0\" twice"]);
    assert_eq!(found(":D0,5,00,8"), [""; 0]);
    assert_eq!(found(":D0.5,0.8"), [""; 0]);
}

#[test]
fn a_variable_that_no_text_uses_has_no_effect() {
    let found = |start: &str, text: &str| {
        codes(
            &raw(&path(&format!("T5 O3 I1 B0 {start}"), &format!("mill 0,0 40,0 \"{text}\"\nend 40,0")))
                .diagnostics,
        )
    };
    assert_eq!(found(":D0~1", "B1"), ["PB210"]);
    assert_eq!(found(":D0~1 :E0~1", "B=D"), ["PB210"]);
    assert_eq!(found(":D0~1", "B=D"), [""; 0]);
    assert_eq!(found(":D0~1", "Qdeep=D"), [""; 0]);
    assert_eq!(found(":D0~1 F=D", "B1"), [""; 0]);
    // `=E` is wrong (PB303), and D was probably intended.
    assert_eq!(found(":D0~1", "B=E"), [""; 0]);
    // The value of another variable refers to D.
    assert_eq!(found(":D0~1 :Ea,=D", "B=E"), [""; 0]);
}

/// A text that is not read may refer to the variable: one without an element, or one in a path that borrows the text of the start.
#[test]
fn a_variable_that_may_be_used_elsewhere_is_not_reported() {
    let with = |text: &str| {
        codes(&raw(&path("T5 O3 I1 B0 :D0~1", &format!("mill 0,0 40,0\n{text}end 40,0"))).diagnostics)
    };
    assert_eq!(with("text 20,90 \"B=D\"\n"), ["PB107"]);
    assert_eq!(with(""), ["PB210"]);
    let borrowed = path("T5 O3 I1 B0 :D0~1", "mill 0,0 40,0\nend 40,0")
        + "\nlayer 1234.2P\nstart 0,50 \"@1234.1P\"\nmill 0,50 40,50 \"B=D\"\nend 40,50\n";
    let codes: Vec<String> =
        read(&borrowed).paths.iter().flat_map(|(raw, _)| codes(&raw.diagnostics)).collect();
    assert_eq!(codes, [""; 0]);
}
