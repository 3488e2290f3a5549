//! Tests reading tools and stock from the comments of programs. All programs here follow the format of the CAM program that is named, but are
//! not copied from it.

use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::header::{FORMS, Header, HeaderReader, parse_comment};
use pathbuild_gcode::interpret::{Options, interpret_each};

fn header(program: &str) -> Header {
    let mut reader = HeaderReader::default();
    interpret_each(program.as_bytes(), Dialect::Rs274, &Options::default(), &mut |step| reader.step(&step));
    reader.finish(200)
}

/// Returns the tools that cut: the line from which they apply, the number, the diameter, and the width that is known to be flat.
fn tools(program: &str) -> Vec<String> {
    let show = |length: f64| format!("{}", (length * 1000.0).round() / 1000.0);
    let tool = |tool: &pathbuild_gcode::header::CuttingTool| {
        let number = tool.number.map_or("-".into(), |number| format!("T{number}"));
        let cutter = tool.cutter.map_or("unknown".into(), |cutter| {
            format!("{} flat {}", show(cutter.diameter), cutter.flat.map_or("?".into(), show))
        });
        format!("{}: {number} {cutter}", tool.line)
    };
    header(program).tools.iter().map(tool).collect()
}

fn problems(program: &str) -> Vec<String> {
    let place = |problem: &pathbuild_diagnostic::Diagnostic| {
        format!("{} {}", problem.place.line.unwrap_or(0), problem.code().name())
    };
    header(program).problems.iter().map(place).collect()
}

const CUT: &str = "G0 X0 Y0 Z5\nG1 Z-1 F100\nG1 X9\nG0 Z5\n";

#[test]
fn samples_are_read_in_their_own_form() {
    for form in FORMS {
        let found = parse_comment(form.sample, &|signature| form.signature == Some(signature));
        assert!(found.is_some_and(|(found, _)| std::ptr::eq(found, form)), "{}", form.sample);
    }
}

#[test]
fn forms_that_could_be_free_text_need_their_signature() {
    for form in FORMS.iter().filter(|form| form.signature.is_some()) {
        assert!(parse_comment(form.sample, &|_| false).is_none(), "{}", form.sample);
    }
}

#[test]
fn free_text_states_nothing() {
    let comments = [
        "18 FLAT CARBIDE ENDMILL",
        "1001 - 1/4\" Facing 6mm",
        "bracket_6mm_D=6.nc",
        // These comments have an unknown key, no diameter, or no value.
        "T1 DIA=6 CR=0 - flat end mill",
        "T1 D=0 CR=0 - ZMIN=4 - laser cutter",
        "T1 D=6 - ZMIN=4 - flat end mill",
        "D1",
        "TOOL/LASER,3,0,0,0",
        "TOOL/MILL,3.17, wide",
        "TOOL/MILL,0, 0, 0, 0",
        "STOCK/BLOCK, 100, 100, 10",
        "STOCK/BLOCK, 100, 100, 0, 0, 0, 0",
        "stockMin:0.00, 0.00, -1.00",
        "stockMid:0.00mm, 0.00mm, -1.00mm",
        // An inch mark is not a unit in FreeCAD's labels.
        "TC: 1/4\" Endmill",
        "TC: 12.7 V90deg Q009",
        "Compensated Tool Path. Diameter: 0",
        "M6 T4.5",
        "2 = V-Bit {60 deg}",
        "2 = Cutter {6 mm}",
        "tool#=1 flute=6 len=20",
        "MSG, Change tool bit to drill size 0.8mm",
        "MSG, Change tool bit to cutter diameter 0.00000in",
        "T2 : 0.0",
        // These comments are by Estlcam and SheetCam.
        "End mill 3mm",
        "Operation: Outside Offset, 0, T1: 3 mm end mill, 2 mm Deep",
    ];
    for comment in comments {
        assert_eq!(parse_comment(comment, &|_| true).map(|(form, _)| form.name), None, "{comment}");
    }
}

#[test]
fn only_a_tip_that_is_named_flat_clears_its_diameter() {
    let tips = [
        ("T1 D=6 CR=0 - ZMIN=-4 - flat end mill", "6 flat 6"),
        ("T01 D=6. CR=0. - ZMIN=-4. - FLAT END MILL - L=0.65/3.609", "6 flat 6"),
        ("T1 D=6 CR=0.5 - ZMIN=-4 - bullnose end mill", "6 flat 5"),
        ("T1 ID=B77 D=0.5 CR=0.03 - ZMIN=-0.4775 - BULL NOSE END MILL", "0.5 flat 0.44"),
        ("T1 D=6 CR=3 - ZMIN=-4 - ball end mill", "6 flat 0"),
        ("T1 D=6 CR=3 - ZMIN=-4 - ball end mill - flat end mill", "6 flat 0"),
        ("T1 D=0.125 CR=0.062 - ZMIN=-4 - ball end mill", "0.125 flat 0.001"),
        ("T1 D=6 CR=2.5 - ZMIN=-4 - ball end mill", "6 flat ?"),
        ("T1 D=6 CR=3 TAPER=2deg - ZMIN=-4 - ball end mill", "6 flat ?"),
        ("T1 D=0.25 CR=0. TAPER=45deg - ZMIN=0.948 - chamfer mill", "0.25 flat ?"),
        ("T1 D=6 CR=0 TAPER=2deg - ZMIN=-4 - flat end mill", "6 flat ?"),
        ("T1 D=0.125 CR=0 - ZMIN=-0.129 - vee", "0.125 flat ?"),
        ("T1 D=50. CR=0. - ZMIN=-1 - face mill", "50 flat 50"),
        ("T1 D=50. CR=1. - ZMIN=-1 - face mill", "50 flat ?"),
        ("T1 D=50. CR=0. TAPER=45deg - ZMIN=-1 - face mill", "50 flat ?"),
        ("TOOL/MILL,6.35, 3.17, 19.05, 0.00", "6.35 flat 0.01"),
        ("TOOL/MILL,6.35, 0.00, 19.05, 0.00", "6.35 flat 6.35"),
        ("TOOL/MILL,0.03, 0.00, 10.00, 30.00", "0.03 flat ?"),
        ("TOOL/MILL,1,0,50", "1 flat ?"),
        ("1 = End Mill {3.175 mm}", "3.175 flat 3.175"),
        ("1 = Ball Nose {6 mm}", "6 flat ?"),
        ("tool#=1 flute=6 len=20 unit=metric", "6 flat ?"),
        ("MSG, Change tool bit to cutter diameter 1.5mm", "1.5 flat ?"),
    ];
    for (comment, tip) in tips {
        assert_eq!(tools(&format!("({comment})\nG21\nT1 M6\n{CUT}")), [format!("3: T1 {tip}")], "{comment}");
    }
}

#[test]
fn the_unit_is_that_of_the_program_unless_the_field_names_one() {
    let with_unit = |comment: &str, unit: &str| tools(&format!("({comment})\n{unit}\nT1 M6\n{CUT}")).concat();
    let fusion = "T1 D=0.25 CR=0 - ZMIN=-1 - flat end mill";
    assert_eq!(with_unit(fusion, "G20"), "3: T1 6.35 flat 6.35");
    assert_eq!(with_unit(fusion, "G21"), "3: T1 0.25 flat 0.25");
    assert_eq!(with_unit("1 = End Mill {3.175 mm}", "G20"), "3: T1 3.175 flat 3.175");
    assert_eq!(with_unit("1 = End Mill {0.125 inch}", "G21"), "3: T1 3.175 flat 3.175");
    assert_eq!(with_unit("tool#=1 flute=0.25 len=1 unit=imperial", "G21"), "3: T1 6.35 flat ?");
    // The unit in force at the comment applies, not the first one of the program.
    let later = format!("G20\nG21\n(TOOL/MILL,6,0,9,0)\nT1 M6\n{CUT}");
    assert_eq!(tools(&later), ["4: T1 6 flat 6"]);
}

#[test]
fn a_description_holds_while_its_tool_is_in_use() {
    let two = "(T1 D=6 CR=0 - ZMIN=-1 - flat end mill)\n(T2 D=3 CR=0 - ZMIN=-1 - flat end mill)\nG21\n";
    assert_eq!(
        tools(&format!("{two}T1 M6\n{CUT}T2 M6\n{CUT}T3 M6\n{CUT}T1 M6\n{CUT}")),
        ["4: T1 6 flat 6", "9: T2 3 flat 3", "14: T3 unknown", "19: T1 6 flat 6"]
    );
    // T alone only selects the next tool, unless the program has no M6.
    assert_eq!(tools(&format!("{two}T1 M6\nT2\n{CUT}")), ["4: T1 6 flat 6"]);
    assert_eq!(tools(&format!("{two}T2\n{CUT}")), ["4: T2 3 flat 3"]);
    // Without a tool change, a description belongs to the tool only if there is no other description.
    assert_eq!(tools(&format!("{two}{CUT}")), ["0: - unknown"]);
    assert_eq!(tools(&format!("(T1 D=6 CR=0 - ZMIN=-1 - flat end mill)\n{CUT}")), ["0: T1 6 flat 6"]);
}

#[test]
fn a_description_without_a_number_ends_with_the_next_tool_change_after_a_cut() {
    let carbide = format!("G21\n(TOOL/MILL,3.17, 0.00, 12.70, 0.00)\nM6 T102\n{CUT}M6 T390\n{CUT}");
    assert_eq!(tools(&carbide), ["3: T102 3.17 flat 3.17", "8: T390 unknown"]);
    let after = format!("G21\nM6 T102\n(TOOL/MILL,3.17, 0.00, 12.70, 0.00)\n{CUT}");
    assert_eq!(tools(&after), ["2: T102 3.17 flat 3.17"]);
}

#[test]
fn freecad_writes_the_tool_change_of_grbl_as_a_comment() {
    let operation = |number: u32, diameter: &str| {
        format!(
            "(Begin operation: TC: {diameter}mm Endmill)\n(TC: {diameter}mm Endmill)\n(Begin toolchange)\n( M6 T{number}.0 )\nM3 S9000\n(Profile)\n(Compensated Tool Path. Diameter: {diameter})\n{CUT}"
        )
    };
    let program = format!(
        "(Exported by FreeCAD)\n(Post Processor: grbl_post)\nG17 G90\nG21\n{}{}",
        operation(3, "3.0"),
        operation(4, "6.35")
    );
    assert_eq!(tools(&program), ["8: T3 3 flat ?", "19: T4 6.35 flat ?"]);
    assert_eq!(problems(&program), [""; 0]);
    // Without the signature, these comments are free text.
    assert_eq!(tools(&program.replace("(Exported by FreeCAD)\n", "")), ["0: - unknown"]);
}

#[test]
fn a_tool_with_two_diameters_is_reported() {
    let twice = |second: &str| {
        format!(
            "(T1 D=6 CR=0 - ZMIN=-1 - flat end mill)\n(T1 D={second} CR=0 - ZMIN=-1 - flat end mill)\nG21\nT1 M6\n{CUT}"
        )
    };
    assert_eq!(problems(&twice("6.02")), [""; 0]);
    assert_eq!(problems(&twice("6.03")), ["2 header-contradiction"]);
    // The narrower of two tools removes material.
    assert_eq!(tools(&twice("3")), ["4: T1 6 flat 3"]);
    // A bull nose and a flat end mill have the same diameter.
    let tips = format!(
        "(T1 D=6 CR=0 - ZMIN=-1 - flat end mill)\n(T1 D=6 CR=1 - ZMIN=-1 - bullnose end mill)\nG21\nT1 M6\n{CUT}"
    );
    assert_eq!(problems(&tips), ["2 header-contradiction"]);
    // Two comments of different forms describe the tool in use.
    let forms = format!("G21\n(TOOL/MILL,3,0,9,0)\n(1 = End Mill {{6 mm}})\nT1 M6\n{CUT}");
    assert_eq!(problems(&forms), ["3 header-contradiction"]);
}

#[test]
fn a_listed_tool_that_is_never_selected_is_reported() {
    let list = "(T1 D=6 CR=0 - flat end mill)\n(T2 D=3 CR=0 - drill)\nG21 G90\n";
    assert_eq!(problems(&format!("{list}T1 M6\nG1 X1 F9\nT2 M6\nG1 X2")), [""; 0]);
    assert_eq!(problems(&format!("{list}T1 M6\nG1 X1 F9\nG1 X2")).len(), 1);
    assert_eq!(problems(&format!("{list}G1 X1 F9\nG1 X2")), [""; 0], "tools are changed by hand");
    // The operator inserts the tool that the list names, and the machine takes T7.
    assert_eq!(problems(&format!("{list}T7 M6\nG1 X1 F9")), ["1 disagreement"]);
}

#[test]
fn the_origin_of_a_stock_block_places_its_surface() {
    let surface = |comments: &str| header(&format!("{comments}\nG21\nG90")).surface;
    assert_eq!(surface("(STOCK/BLOCK,100.00, 100.00, 1.00,0.00, 0.00, 1.00)"), Some(0.0));
    assert_eq!(surface("(STOCK/BLOCK,100.00, 100.00, 1.00,0.00, 0.00, 0.00)"), Some(1.0));
    assert_eq!(surface("(stockMax:100.00mm, 100.00mm, 2.50mm)"), Some(2.5));
    assert_eq!(surface("(stockMin:0.00mm, 0.00mm, -1.00mm)"), None);
    assert_eq!(header("(stockMax:20.000in, 10.000in, 1.000in)\nG21").surface, Some(25.4));
    assert_eq!(header("(STOCK/BLOCK,4,4,1,0,0,0)\nG20").surface, Some(25.4));
}

#[test]
fn a_stock_with_two_positions_is_reported_and_the_higher_one_counts() {
    let low = |z: &str| {
        format!("(stockMin:0.00mm, 0.00mm, {z}mm)\n(STOCK/BLOCK,100.00, 100.00, 1.00,0.00, 0.00, 1.00)\nG21")
    };
    assert_eq!(problems(&low("-1.02")), [""; 0]);
    assert_eq!(problems(&low("-1.03")), ["2 header-contradiction"]);
    let high = "(stockMax:100.00mm, 100.00mm, 2.00mm)\n(STOCK/BLOCK,100,100,1,0,0,1)\nG21";
    assert_eq!(problems(high), ["2 header-contradiction"]);
    assert_eq!(header(high).surface, Some(2.0));
}

#[test]
fn the_header_of_pathbuild_holds_for_all_tools() {
    let program =
        format!("(pathbuild 0.1.0 0123456789abcdef-01234567 rs274 O2 T5)\nG20\nT1 M6\n{CUT}T2 M6\n{CUT}");
    assert_eq!(tools(&program), ["3: T1 2 flat 2", "8: T2 2 flat 2"]);
    assert_eq!(header(&program).surface, Some(5.0));
}

/// Returns a program with a header of pathbuild, and a cut with T1 unless `tool` names another tool.
fn of_pathbuild(words: &str, tool: &str) -> String {
    format!("(pathbuild 0.1.0 0123456789abcdef-01234567 rs274 {words})\nG21\n{tool}\n{CUT}")
}

#[test]
fn headers_of_programs_put_together_are_compared() {
    let two = |second: &str, tool: &str| of_pathbuild("O2 T5", "T1") + &of_pathbuild(second, tool);
    assert_eq!(problems(&two("O2 T5", "T1")), [""; 0]);
    assert_eq!(problems(&two("O2 T2", "T1")), ["8 header-contradiction"]);
    assert_eq!(header(&two("O2 T2", "T1")).surface, Some(5.0));
    let reversed = of_pathbuild("O2 T2", "T1") + &of_pathbuild("O2 T5", "T1");
    assert_eq!((header(&reversed).surface, problems(&reversed).len()), (Some(5.0), 1));
    // Another tool may have another diameter.
    assert_eq!(problems(&two("O1 T5", "T1")), ["8 header-contradiction"]);
    assert_eq!(tools(&two("O1 T5", "T1")), ["3: T1 2 flat 2", "10: T1 2 flat 1"]);
    assert_eq!(problems(&two("O1 T5", "T2")), [""; 0]);
    assert_eq!(tools(&two("O1 T5", "T2")), ["3: T1 2 flat 2", "10: T2 1 flat 1"]);
    // Marlin has no T, and a program may state no thickness.
    let marlin = of_pathbuild("O2 T5", "") + &of_pathbuild("O1", "");
    assert_eq!(problems(&marlin), ["8 header-contradiction"]);
}

#[test]
fn the_list_of_tools_of_pathbuild_is_read() {
    let joined = |changes: [&str; 2]| {
        let [first, second] = changes;
        format!(
            "(pathbuild 0.1.0 0123456789abcdef-01234567 grbl T2)\n(T1: 2.0 2mm)\n(T2: 1.0)\nG21\n{first}\n{CUT}{second}\n{CUT}"
        )
    };
    assert_eq!(tools(&joined(["T1", "T2"])), ["5: T1 2 flat 2", "10: T2 1 flat 1"]);
    assert_eq!(problems(&joined(["T1", "T2"])), [""; 0]);
    assert_eq!(problems(&joined(["T1", ""])), ["3 disagreement"]);
    assert_eq!(problems(&joined(["", "T2"])), ["2 disagreement"]);
    assert_eq!(problems(&joined(["T1", "T3"])), ["3 disagreement"]);
    // Without a header of pathbuild, the comments are free text.
    let foreign = joined(["T1", ""]).replace("(pathbuild ", "(");
    assert_eq!(problems(&foreign), [""; 0]);
    // The posts for Haas and Fanuc write upper case only.
    let upper = |changes| joined(changes).to_uppercase();
    assert_eq!(tools(&upper(["T1", "T2"])), ["5: T1 2 flat 2", "10: T2 1 flat 1"]);
    assert_eq!(problems(&upper(["T1", ""])), ["3 disagreement"]);
}

#[test]
fn messages_of_the_post_for_marlin_name_the_tools_to_insert() {
    let joined = |change: &str| {
        format!(
            "(pathbuild 0.1.0 0123456789abcdef-01234567 marlin T2)\n(T1: 2.0 2mm)\n(T2: 1.0)\nG21\n{CUT}(Insert T2: 1.0)\n{change}\n{CUT}"
        )
    };
    let change = "M0 (Insert T2, set Z zero)";
    assert_eq!(tools(&joined(change)), ["0: T1 2 flat 2", "10: T2 1 flat 1"]);
    assert_eq!(problems(&joined(change)), [""; 0]);
    assert_eq!(problems(&joined("")), ["3 disagreement"]);
    assert_eq!(problems(&joined("M0 (Insert T3, set Z zero)")), ["3 disagreement"]);
    // The tool may be changed at a stop that names none.
    assert_eq!(
        (tools(&joined("M0")), problems(&joined("M0"))),
        (vec!["0: - unknown".to_owned()], Vec::new())
    );
    let foreign = joined(change).replace("(pathbuild ", "(");
    assert_eq!((tools(&foreign), problems(&foreign)), (vec!["0: - unknown".to_owned()], Vec::new()));
}
