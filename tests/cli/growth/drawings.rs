//! Drawings in which some feature occurs a given number of times.
#![allow(unreachable_pub, reason = "one binary's own module")]

pub fn entities(drawn: &str, end: (f64, f64)) -> String {
    format!(
        "0\nSECTION\n2\nENTITIES\n{}{}0\nTEXT\n8\n1202.1P\n10\n0\n20\n0\n40\n1\n1\nT5 O2 I5 B0 MX\n{drawn}0\nENDSEC\n0\nEOF\n",
        circle((0.0, 0.0), 0.5),
        circle(end, 1.0),
    )
}

fn circle((x, y): (f64, f64), radius: f64) -> String {
    format!("0\nCIRCLE\n8\n1202.1P\n6\nPHANTOM\n10\n{x}\n20\n{y}\n40\n{radius}\n")
}

pub fn line((x, y): (f64, f64), (u, v): (f64, f64)) -> String {
    format!("0\nLINE\n8\n1202.1P\n6\nCONTINUOUS\n10\n{x}\n20\n{y}\n11\n{u}\n21\n{v}\n")
}

fn at(index: usize) -> (f64, f64) {
    let index = u32::try_from(index).unwrap();
    (f64::from(index) * 0.25, f64::from(index % 2) * 3.0)
}

/// Returns lines that all have the same ends.
pub fn fan(count: usize) -> String {
    entities(&line((0.0, 0.0), (10.0, 0.0)).repeat(count + 1), (10.0, 0.0))
}

/// Returns lines from a common point, with a turn marker at each tip.
pub fn star(count: usize) -> String {
    let spoke = |index: usize| {
        let angle = 6.0 * f64::from(u32::try_from(index).unwrap()) / f64::from(u32::try_from(count).unwrap());
        let tip = (50.0 * angle.cos(), 50.0 * angle.sin());
        line((0.0, 0.0), tip) + &circle(tip, 0.75)
    };
    let spokes: String = (0..count).map(spoke).collect();
    entities(&(spokes + &line((0.0, 0.0), (100.0, 0.0))), (100.0, 0.0))
}

pub fn chain(count: usize) -> String {
    entities(&(0..count).map(|index| line(at(index), at(index + 1))).collect::<String>(), at(count))
}

/// Returns a chain of lines, and as many probes beside it, in columns of 20.
pub fn probed(count: usize) -> String {
    let place = |index: usize| {
        let [row, place] = [index / 20, index % 20].map(|it| 8.0 * f64::from(u32::try_from(it).unwrap()));
        circle((row, 4.25 + place), 3.0)
    };
    let probes: String = (0..count).map(place).collect();
    let lines: String = (0..count).map(|index| line(at(index), at(index + 1))).collect();
    entities(&(probes + &lines), at(count))
}

/// Returns lines whose ends nearly meet.
pub fn gaps(count: usize) -> String {
    let with_gap = |index: usize| {
        let ((x, y), to) = (at(index), at(index + 1));
        line((x + 0.004, y), to)
    };
    entities(&(0..count).map(with_gap).collect::<String>(), at(count))
}

/// Returns lines with ends that lie close together at two places, but never meet.
pub fn spots(count: usize) -> String {
    const IN_A_ROW: usize = 30;
    let spot = |index: usize| {
        let (row, place) = (index / 2 / IN_A_ROW, index / 2 % IN_A_ROW);
        let [row, place] = [row, place].map(|it| 0.000_1 * f64::from(u32::try_from(it).unwrap()));
        (place, row + if index.is_multiple_of(2) { 0.0 } else { 3.0 })
    };
    let with_gap = |index: usize| {
        let ((x, y), to) = (spot(index), spot(index + 1));
        line((x + 0.000_05, y), to)
    };
    entities(&(0..count).map(with_gap).collect::<String>(), spot(count))
}

pub fn fan_behind_gap(count: usize) -> String {
    entities(&line((0.004, 0.0), (10.0, 0.0)).repeat(count + 1), (10.0, 0.0))
}

pub fn polyline(count: usize) -> String {
    let vertices: Vec<String> = (0..=count).map(at).map(|(x, y)| format!("10\n{x}\n20\n{y}\n")).collect();
    let vertices = vertices.concat();
    let drawn = format!("0\nLWPOLYLINE\n8\n1202.1P\n6\nCONTINUOUS\n90\n{}\n70\n0\n{vertices}", count + 1);
    entities(&drawn, at(count))
}

/// Writes a number in letters, because names of layers have no digits after the tilde.
fn letters(number: usize) -> String {
    [number / 676, number / 26 % 26, number % 26]
        .map(|digit| (b'A'..=b'Z').nth(digit).map_or('A', char::from))
        .iter()
        .collect()
}

/// Moves an element to one of the path's layers.
fn on_layer(number: usize, drawn: &str) -> String {
    drawn.replace("\n8\n1202.1P\n", &format!("\n8\n1202.1P~{}\n", letters(number)))
}

fn text((x, y): (f64, f64), text: &str) -> String {
    format!("0\nTEXT\n8\n1202.1P\n10\n{x}\n20\n{y}\n40\n1\n1\n{text}\n72\n1\n11\n{x}\n21\n{y}\n73\n2\n")
}

fn with_line(drawn: &str) -> String {
    entities(&(line((0.0, 0.0), (9.0, 0.0)) + drawn), (9.0, 0.0))
}

/// Returns layers with one line each, all lines at the same place, and as many texts near them on a further layer.
pub fn lost_texts(count: usize) -> String {
    let lines: String = (0..count).map(|layer| on_layer(layer, &line((20.0, 0.0), (30.0, 0.0)))).collect();
    with_line(&(lines + &on_layer(count, &text((25.0, 0.0), "B1")).repeat(count)))
}

/// Returns layers with a line each, and a text for each on a separate layer.
pub fn lost_texts_apart(count: usize) -> String {
    let height = |layer: usize| 9.0 * f64::from(u32::try_from(layer).unwrap());
    let drawn = |layer: usize| {
        on_layer(layer, &line((20.0, height(layer)), (30.0, height(layer))))
            + &on_layer(count + layer, &text((25.0, height(layer)), "B1"))
    };
    with_line(&(0..count).map(drawn).collect::<String>())
}

/// Returns insertions without a valid position, of a block with a line on each of 50 layers.
pub fn broken_insertions(count: usize) -> String {
    let insert = "0\nINSERT\n8\n1202.1P\n2\nX\n10\na\n20\n0\n".repeat(count);
    let lines: String = (0..50).map(|layer| on_layer(layer, &line((0.0, 0.0), (1.0, 0.0)))).collect();
    let block = format!("0\nBLOCK\n8\n0\n2\nX\n10\n0\n20\n0\n{lines}0\nENDBLK\n");
    format!("0\nSECTION\n2\nBLOCKS\n{block}0\nENDSEC\n{}", with_line(&insert))
}

/// Returns variables that each refer to themselves, and a text that refers to the last one often.
pub fn circular_variables(count: usize) -> String {
    let names: Vec<char> = (0x4e00..).map_while(char::from_u32).take(count).collect();
    let defined = names.iter().map(|name| format!(" :{name}={name},={name}")).collect::<Vec<_>>().concat();
    let drawn =
        with_line(&text((4.5, 0.0), &format!("Q{}", format!("={}", names[count - 1]).repeat(2 * count))));
    let header = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1021\n0\nENDSEC\n";
    format!("{header}{}", drawn.replacen("B0 MX", &format!("B0 MX{defined}"), 1))
}

pub fn open_commands(count: usize) -> String {
    with_line(&format!(
        "0\nMTEXT\n8\n1202.1P\n10\n4.5\n20\n0\n40\n0.001\n71\n5\n1\nB1 Q{}\n",
        "\\A".repeat(count)
    ))
}
