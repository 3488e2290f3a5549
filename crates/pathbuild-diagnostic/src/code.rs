//! The codes of diagnostics, and the pages that `pathbuild explain` prints.

use std::fmt;
use std::str::FromStr;

use crate::words::Lang;

/// The severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
pub enum Severity {
    /// An error: the path gets no program, and the exit status is 1.
    Error,
    /// A warning: the program is written nevertheless.
    Warning,
}

impl Severity {
    /// Returns the name in machine-readable formats: `error` or `warning`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
        }
    }

    /// Returns the word for the severity in messages.
    pub fn word(self, lang: Lang) -> &'static str {
        match self {
            Self::Error => lang.choose("error", "Fehler"),
            Self::Warning => lang.choose("warning", "Warnung"),
        }
    }
}

/// Includes a file of the directory `pages` as text: the page or the example of a code.
macro_rules! page {
    ($number:literal $extension:literal) => {
        include_str!(concat!("pages/PB", stringify!($number), $extension))
    };
}

macro_rules! example {
    ($number:literal) => {
        Some(page!($number ".draw"))
    };
    ($number:literal no example) => {
        None
    };
}

/// Declares the codes, each with its number, variant, name, default severity and meaning, and whether it has an example.
macro_rules! codes {
    ($($number:literal $variant:ident $name:literal $severity:ident $when:literal $(no $example:ident)?;)*) => {
        /// The code of a diagnostic. Codes are stable: a number is never reused for anything else. (book: reference/diagnostics)
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Code {
            $(#[doc = concat!("PB", stringify!($number), ": ", $when)] $variant,)*
        }

        impl Code {
            /// All codes, in order of their numbers.
            pub const ALL: &[Self] = &[$(Self::$variant),*];

            /// Returns the number of the code: 203 for `PB203`.
            #[expect(clippy::zero_prefixed_literal, reason = "the number as it stands in file names")]
            pub fn number(self) -> u16 {
                match self { $(Self::$variant => $number,)* }
            }

            /// Returns the readable name, for example `parameter-out-of-range`.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// Returns the default severity.
            pub const fn severity(self) -> Severity {
                match self { $(Self::$variant => Severity::$severity,)* }
            }

            /// Returns the page that `pathbuild explain` prints, as Markdown: meaning, usual causes, remedy, example. The page of either
            /// language ends with the example (tests/cli/book/examples.rs).
            pub fn page(self, lang: Lang) -> &'static str {
                match (self, lang) {
                    $((Self::$variant, Lang::En) => page!($number ".en.md"),
                    (Self::$variant, Lang::De) => page!($number ".de.md"),)*
                }
            }

            /// Returns the example on the page: a fixture for the test kit (crates/pathbuild-testkit) whose commands give exactly the noted
            /// diagnostics. `None` if the problem cannot be shown in a few lines.
            pub fn example(self) -> Option<&'static str> {
                match self { $(Self::$variant => example!($number $(no $example)?),)* }
            }
        }
    };
}

codes! {
    001 UnreadableFile "unreadable-file" Error "a file cannot be opened or read";
    002 InvalidDxf "invalid-dxf" Error "not a valid DXF file, with the line";
    003 InvalidConfiguration "invalid-configuration" Error "an error in pathbuild.toml or in the value of an option";
    004 CannotWrite "cannot-write" Error "a file cannot be written, with the reason; files are never written partially";
    005 LimitReached "limit-reached" Error "a limit is exceeded, with the key of the limit";
    006 InternalError "internal-error" Error "a bug in pathbuild, which only affects one drawing" no example;
    007 NoEndOfFile "no-end-of-file" Warning "a DXF file without its end marker";
    008 DoubtfulEncoding "doubtful-encoding" Warning "bytes that are not valid in the declared encoding";
    101 MissingStart "missing-start" Error "a path without a start marker";
    102 MissingEnd "missing-end" Error "a path without an end marker";
    103 TwoStarts "two-starts" Error "a path with two start markers";
    104 TwoEnds "two-ends" Error "a path with two end markers";
    105 UnknownSpecialCircle "unknown-special-circle" Error "a PHANTOM, DOT or DASHDOT circle with a diameter that has no meaning";
    106 UnknownLineType "unknown-line-type" Error "unknown line type";
    107 TextWithoutElement "text-without-element" Error "a text without an element";
    109 CircleTooSmall "circle-too-small" Error "a circle smaller than the cutter";
    110 OffPlane "off-plane" Error "an element outside the plane Z = 0";
    111 UnsupportedCurve "unsupported-curve" Warning "a curve on a path layer that is ignored";
    112 LayerNotVisible "layer-not-visible" Warning "a path layer that is frozen or off";
    113 WrongUnits "wrong-units" Error "a drawing in a unit other than millimetres";
    114 TurnMarkerWithoutEffect "turn-marker-without-effect" Warning "turn marker without effect";
    115 JoinedEnds "joined-ends" Warning "ends joined within join-tolerance";
    116 DoubtfulText "doubtful-text" Warning "a text that almost belongs to another element";
    117 InvalidKeepOut "invalid-keep-out" Error "a clamp with an unclear outline or height";
    118 NearlyDrilled "nearly-drilled" Warning "a circle only slightly larger than the cutter";
    119 TextOnOtherLayer "text-on-other-layer" Warning "a parameter text on a layer that is not a path layer, or the height of a clamp on a layer without clamps";
    120 NearlyPathLayer "nearly-path-layer" Warning "a layer whose name resembles that of a path layer, or of one with clamps or finished parts";
    121 LeftoverElement "leftover-element" Warning "a line or arc of almost no length, or an element on another one";
    201 MissingParameter "missing-parameter" Error "a required parameter that is neither specified nor inherited";
    202 UnknownParameter "unknown-parameter" Error "a letter that has no meaning for this element";
    203 ParameterOutOfRange "parameter-out-of-range" Error "a value outside its limits";
    204 DuplicateParameter "duplicate-parameter" Error "duplicate parameter";
    205 NotANumber "not-a-number" Error "not a number";
    206 VariableNotAllowed "variable-not-allowed" Error "a variable in N, O or @";
    207 MissingPathParameters "missing-path-parameters" Error "start marker without a text";
    208 InvalidAtReference "invalid-at-reference" Error "an invalid use of @: with other letters, without a path, or with a path that uses @";
    209 InvalidRegex "invalid-regex" Error "an invalid regular expression in E";
    210 ParameterWithoutEffect "parameter-without-effect" Warning "parameter without effect";
    211 DoubtfulValue "doubtful-value" Warning "a permitted but unlikely value";
    212 LostBars "lost-bars" Warning "P or U in a path without support bars";
    213 GougedPart "gouged-part" Error "a cut goes into the finished part; up to 0.1 mm deep, a warning";
    214 GougedNeighbour "gouged-neighbour" Error "a cut of one component goes into the part of another";
    215 LeftoverAtPart "leftover-at-part" Warning "material that remains at the outline of the finished part";
    216 UnreachableCorner "unreachable-corner" Warning "inner corners of the finished part that the cutter does not reach";
    217 LoosePart "loose-part" Warning "a finished part that is cut out all round without a support bar";
    218 BarCutAway "bar-cut-away" Error "a support bar that another cut removes";
    219 DoubtfulOutline "doubtful-outline" Warning "an outline of a finished part that is not closed or cannot be read";
    220 OutlineNotCut "outline-not-cut" Warning "an outline of a finished part that no cut through the material comes near";
    221 DisplacedPath "displaced-path" Warning "paths that cut the same finished part, but place it differently";
    222 CutInLooseWaste "cut-in-loose-waste" Warning "a cut in a piece of waste that an earlier cut has made loose";
    223 PartInOpening "part-in-opening" Warning "an outline in an opening of a finished part that is cut as a part of its own";
    301 InvalidVariableDefinition "invalid-variable-definition" Error "invalid variable definition";
    302 MissingVariableValue "missing-variable-value" Error "missing variable value";
    303 UnknownVariable "unknown-variable" Error "a value or reference of an undefined variable";
    304 VariableValueNotAllowed "variable-value-not-allowed" Error "variable value not allowed";
    305 EndlessVariable "endless-variable" Error "a variable that refers to itself";
    401 NothingContinues "nothing-continues" Error "nothing continues";
    402 UnreachedSegments "unreached-segments" Error "unreached segments";
    403 EndNotReached "end-not-reached" Error "end not reached";
    404 EmptyPath "empty-path" Error "empty path";
    405 HelixTooLarge "helix-too-large" Error "a helical circle larger than A";
    406 NoRoomBetweenBars "no-room-between-bars" Error "the cutter does not fit between two support bars";
    407 InsideKeepOut "inside-keep-out" Error "the tool hits a clamp";
    408 NoGapBetweenBars "no-gap-between-bars" Warning "support bars without gaps: the whole segment is left standing";
    501 MissingSubpathName "missing-subpath-name" Error "missing subpath name";
    502 InvalidPathName "invalid-path-name" Error "invalid path name";
    503 PathNotFound "path-not-found" Error "path not found";
    504 PathDefinedTwice "path-defined-twice" Error "path defined twice";
    505 SubpathSizeDiffers "subpath-size-differs" Error "subpath size differs";
    506 SubpathParameterDiffers "subpath-parameter-differs" Error "T, O or M of segment and path differ";
    507 SubpathForbidden "subpath-forbidden" Error "forbidden by E or --restrict";
    508 NestingTooDeep "nesting-too-deep" Error "nesting too deep";
    509 SubpathCycle "subpath-cycle" Error "subpath cycle";
    510 PathTBelowSubpathT "path-t-below-subpath-t" Error "T of a path is less than that of a subpath in it";
    511 SubpathHasErrors "subpath-has-errors" Error "an embedded path has errors of its own";
    512 SeveralPaths "several-paths" Error "a drawing with several paths is named where a path is needed";
    513 NoPath "no-path" Error "a file without a path is checked or emitted";
    514 SameOutput "same-output" Error "two outputs with the same name";
    515 QProjectLacksPath "q-project-lacks-path" Warning "a Q-project lacks a path of its drawing";
    516 QProjectDiffers "q-project-differs" Warning "a subpath text of a Q-project differs from the proxy line";
    517 ProxyDiffers "proxy-differs" Error "a proxy line disagrees with its own path";
    518 NothingFound "nothing-found" Error "no drawing, or no path in any drawing";
    519 PromisedPath "promised-path" Warning "a file named after a path that is not in it";
    520 StaleOutput "stale-output" Warning "an output that would not be written any more";
    521 StrayPath "stray-path" Warning "a path in a file whose name does not cover it";
    522 OlderOutput "older-output" Warning "a program of a path that has errors now";
    523 UnmadeCheck "unmade-check" Error "a check that --require or `[verify] require` demands was not made";
    524 LoweredError "lowered-error" Error "a program is not written because of an error that pathbuild.toml lowers";
    525 MirroredSubpath "mirrored-subpath" Warning "a subpath segment in a block that is inserted mirrored" no example;
    526 UnusedConfiguration "unused-configuration" Warning "a pathbuild.toml in a searched directory that does not apply";
    527 PatternWithoutLayer "pattern-without-layer" Warning "`keep-out` or `part` matches no layer of the whole library";
    528 NotCurrent "not-current" Error "a file is missing or is not what `emit` would write";
    529 GlobWithoutFile "glob-without-file" Warning "a glob of `[[severity-in]]` matches no file";
    530 ProgramNumber "program-number" Warning "programs with the same number, or a number that controls reserve for macros";
    601 InvalidProbeLine "invalid-probe-line" Error "invalid probe line";
    602 CorrectionTooLarge "correction-too-large" Error "correction too large";
    603 UnknownProbe "unknown-probe" Error "unknown probe";
    604 InvalidFormula "invalid-formula" Error "invalid formula";
    605 ProbeValuesPresent "probe-values-present" Error "a _Z.txt file with values would be overwritten";
    606 OutsideProbes "outside-probes" Warning "milling outside the hull of the probes";
    607 OddProbe "odd-probe" Warning "a probe that does not fit its neighbours";
    608 OldProgram "old-program" Error "a program to be adjusted that differs from its drawing";
    609 UnusedProbe "unused-probe" Error "a probe that no formula uses";
    610 UnusedWaiver "unused-waiver" Warning "a waiver that matches no finding any more";
    612 UnreadableDescription "unreadable-description" Error "a description of a machine or of tools that cannot be read or imported";
    613 UnusableValue "unusable-value" Warning "a value of a description that the configuration cannot take";
    701 NotGCode "not-g-code" Error "a file without any G-code";
    702 UnknownCharacter "unknown-character" Error "a character that cannot begin a word";
    703 InvalidWord "invalid-word" Error "a letter without a number, or with an invalid one";
    704 InvalidComment "invalid-comment" Error "a comment that is not closed, or within another one";
    705 InvalidExpression "invalid-expression" Error "an expression or a parameter that cannot be read";
    706 LongLine "long-line" Error "a line longer than the control accepts";
    707 DoubtfulSpelling "doubtful-spelling" Warning "a notation that the dialect may not accept, or that is read differently than it looks";
    708 RealTimeCharacter "real-time-character" Error "a character that the control acts on immediately, even in a comment";
    709 AfterProgramEnd "after-program-end" Warning "lines after the end of the program";
    710 NoProgramEnd "no-program-end" Warning "a program that ends without M2, M30 or %";
    711 OptionalLine "optional-line" Warning "a line that a switch on the machine can skip";
    720 UnknownWord "unknown-word" Error "a word that the dialect does not accept";
    721 WordNotFollowed "word-not-followed" Error "a word that the dialect accepts and pathbuild cannot follow";
    722 IgnoredWord "ignored-word" Warning "a word that the dialect ignores";
    723 ConflictingWords "conflicting-words" Error "words that exclude each other in one line";
    724 MissingWord "missing-word" Error "a word required by another one is missing";
    725 ValueOutOfRange "value-out-of-range" Error "a value that is not allowed for its word";
    726 UnusedWord "unused-word" Error "a word that is not used in its line";
    727 CannotEvaluate "cannot-evaluate" Error "an expression that cannot be evaluated";
    728 MachineValue "machine-value" Warning "a value that only the machine knows";
    729 UnknownOffset "unknown-offset" Warning "a coordinate system or position with an unknown offset";
    730 UnitsNotStated "units-not-stated" Warning "no unit before the first move, or a contradictory one";
    731 ModesNotStated "modes-not-stated" Warning "distance mode or plane not stated before the first move";
    732 MotionNotStated "motion-not-stated" Warning "coordinates without a motion word, for a dialect that may not repeat the last one";
    733 MissingFeed "missing-feed" Error "a cutting move without feed, or with feed 0";
    734 ArcRadiiDiffer "arc-radii-differ" Error "an arc whose ends have different radii";
    735 InvalidArc "invalid-arc" Error "an impossible arc";
    736 DoubtfulArc "doubtful-arc" Warning "an arc that depends on the last digit of its numbers, or that probably runs the wrong way round";
    737 StopBeforeMotion "stop-before-motion" Warning "M5 or M9 in the line of a move, which most controls execute before the move";
    738 UselessProbe "useless-probe" Warning "a probing move that cannot touch anything";
    739 MovesDiffer "moves-differ" Error "two programs that should have the same moves differ";
    740 RapidInMaterial "rapid-in-material" Error "a rapid move through material that has not been removed";
    741 RapidPlunge "rapid-plunge" Error "a rapid move down into material";
    742 StartNotRaised "start-not-raised" Warning "a move in the plane before the cutter is known to be above the material";
    743 EndNotRaised "end-not-raised" Warning "the program ends with the cutter in the material";
    744 DiagonalRapid "diagonal-rapid" Warning "a rapid move sideways and down at once, below the material's surface";
    745 SpindleOff "spindle-off" Error "cutting with the spindle off, in a program that switches it";
    746 SpindleSpeed "spindle-speed" Error "a spindle speed outside the machine's range";
    747 FeedTooHigh "feed-too-high" Warning "a feed that exceeds the maximum of the machine";
    748 OutsideMachine "outside-machine" Error "a move outside the machine's travel";
    749 ToolChangeAtDepth "tool-change-at-depth" Error "a tool change with the cutter in the material";
    750 InvalidPost "invalid-post" Error "an invalid post-processor definition";
    751 UnknownMacro "unknown-macro" Error "an undefined macro or variable";
    752 DoubtfulPost "doubtful-post" Warning "a definition, or what it writes, is doubtful";
    753 EndlessMacro "endless-macro" Error "macros that contain each other, or produce too much text";
    754 MissingPostValue "missing-post-value" Error "a post asks for a value that the program does not have";
    755 LostDrilling "lost-drilling" Error "a hole that the post would not drill";
    756 RoundedArc "rounded-arc" Error "an arc that is no longer circular after rounding";
    757 FlattenedArc "flattened-arc" Warning "an arc that the post replaces by a line far from it";
    758 UnreadableLine "unreadable-line" Warning "a line of the post's output that is not G-code";
    759 InvalidControlText "invalid-control-text" Error "a control text that is invalid or cannot be evaluated";
    760 DoubtfulControlText "doubtful-control-text" Warning "a control text that is probably not meant as written";
    761 InjectedFile "injected-file" Error "a file inserted by a control text is missing or outside the post's directory";
    762 RejectedWord "rejected-word" Error "the output has words or characters that the target's dialect rejects";
    763 LineTooLong "line-too-long" Error "a line of the output is longer than the target's dialect accepts";
    764 UnknownTool "unknown-tool" Warning "the tool table has no cutter for a path, or several that fit it equally well";
    765 NothingToPost "nothing-to-post" Error "a program that a post cannot write";
    766 UnknownPost "unknown-post" Error "a post-processor that does not exist";
    767 PostDiffers "post-differs" Error "the output of a post has other moves than the program";
    768 PostBuildFailed "post-build-failed" Error "the command that a post names does not run, or fails";
    769 UncorrectedHeights "uncorrected-heights" Error "a program whose heights are still to be corrected; a post does not write it, and `verify` warns";
    770 SpindleLeftOn "spindle-left-on" Warning "a program that ends with the spindle turning";
    771 CoarseArcs "coarse-arcs" Warning "arcs in millimetres with fewer than three decimals";
    772 ProbeNotRaised "probe-not-raised" Warning "a move in the plane straight after a probe has met something";
    773 ActiveComment "active-comment" Warning "a comment that the control obeys";
    774 OffsetLeftOn "offset-left-on" Warning "an offset (G52, G92) that still holds at the end";
    775 FormulaDiffers "formula-differs" Error "a height that is not what its correction formula comes to, or a formula that is not the drawing's";
    776 UncheckedFormula "unchecked-formula" Error "a correction formula whose probes or measured heights the program does not state, or a height that lacks one";
    777 Disagreement "disagreement" Warning "two places say different things: header and tool table, option and drawing, comments and moves";
    778 ForeignWord "foreign-word" Warning "a word that the post does not write and that is not followed";
    779 UnnamedDialect "unnamed-dialect" Warning "a word on which dialects disagree, in a program whose dialect is not named";
    780 HeaderContradiction "header-contradiction" Warning "comments that describe a tool or the stock in two ways";
    781 RapidAtDepth "rapid-at-depth" Warning "a rapid move at cutting depth, where the surface of the material is unknown";
    782 UnknownPosition "unknown-position" Warning "a cut that begins before the program has stated X and Y";
    783 SpindleDirection "spindle-direction" Error "a cut with the spindle turning in the opposite direction to that of its tool";
    784 SpinningAtChange "spinning-at-change" Warning "a tool change by hand while the spindle turns";
    785 WrongToolLength "wrong-tool-length" Error "a cut with the length of another tool, or without one";
    786 ProbeWithSpindleOn "probe-with-spindle-on" Error "a probing move with the spindle turning";
    787 RoundedCorners "rounded-corners" Warning "the control may round corners by more than `part-tolerance`";
    788 UnitChanged "unit-changed" Warning "a feed, an offset or a drilling cycle that was stated in the other unit";
    789 CycleLeftOn "cycle-left-on" Warning "a drilling cycle that is still on after a tool change";
    790 DoubtfulChipLoad "doubtful-chip-load" Warning "a chip load outside the limits of `[tool]`";
    791 StopAtDepth "stop-at-depth" Warning "a stop for the operator with the cutter in the material";
    792 CutDeeperThanEdges "cut-deeper-than-edges" Warning "a cut deeper than the cutting edges of its tool are long";
    793 CutInHigherMaterial "cut-in-higher-material" Warning "a cut through material that is higher than its own path says";
}

impl Code {
    /// Whether the configuration may lower the severity, as it may for all warnings and for errors from PB610 on. (book: reference/configuration)
    pub fn can_be_lowered(self) -> bool {
        self.severity() == Severity::Warning || self.number() >= 610
    }

    /// Whether such problems are found in programs, or when programs are written. `check`, which judges drawings, does not search for them.
    pub fn is_about_programs(self) -> bool {
        matches!(self.number(), 514 | 520 | 522..=524 | 528 | 530 | 601..=609 | 701..=789 | 791)
    }
}

/// Formats the code as `PB203`.
impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "PB{:03}", self.number())
    }
}

/// Parses `PB203` in any case, or the readable name.
impl FromStr for Code {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let is_match = |code: &&Self| code.to_string().eq_ignore_ascii_case(text) || code.name() == text;
        Self::ALL.iter().find(is_match).copied().ok_or(())
    }
}
