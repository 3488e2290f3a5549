use std::fmt;
use std::str::FromStr;

/// The severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
pub enum Severity {
    /// The path gets no program, and the exit status is 1.
    Error,
    /// A warning, which does not prevent anything.
    Warning,
}

macro_rules! codes {
    ($($number:literal $variant:ident $name:literal $severity:ident $when:literal;)*) => {
        /// The code of a diagnostic. Codes are stable: a number is never reused for anything else. (book: reference/diagnostics)
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Code {
            $(#[doc = $when] $variant,)*
        }

        impl Code {
            /// All codes in order of their numbers.
            pub const ALL: &[Self] = &[$(Self::$variant),*];

            /// The number in `PB203`.
            pub fn number(self) -> u16 {
                match self { $(Self::$variant => $number,)* }
            }

            /// The readable name, for example `parameter-out-of-range`.
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $name,)* }
            }

            /// The default severity.
            pub fn severity(self) -> Severity {
                match self { $(Self::$variant => Severity::$severity,)* }
            }
        }
    };
}

codes! {
    1 UnreadableFile "unreadable-file" Error "PB001: cannot be opened or read";
    2 InvalidDxf "invalid-dxf" Error "PB002: not a DXF file, or broken (with the line)";
    3 InvalidConfiguration "invalid-configuration" Error "PB003: pathbuild.toml or an option's value is wrong, a regular expression in it included";
    4 CannotWrite "cannot-write" Error "PB004: with the reason; nothing half written";
    5 LimitReached "limit-reached" Error "PB005: names the limit's key";
    6 InternalError "internal-error" Error "PB006: a bug: for that drawing only; says how to report it";
    7 NoEndOfFile "no-end-of-file" Warning "PB007: no end of file";
    8 DoubtfulEncoding "doubtful-encoding" Warning "PB008: bytes that the declared code page does not know";
    101 MissingStart "missing-start" Error "PB101: path without start marker";
    102 MissingEnd "missing-end" Error "PB102: path without end marker";
    103 TwoStarts "two-starts" Error "PB103: two starts";
    104 TwoEnds "two-ends" Error "PB104: two ends";
    105 UnknownSpecialCircle "unknown-special-circle" Error "PB105: PHANTOM, DOT or DASHDOT circle of another diameter";
    106 UnknownLineType "unknown-line-type" Error "PB106: unknown line type";
    107 TextWithoutElement "text-without-element" Error "PB107: text without element";
    109 CircleTooSmall "circle-too-small" Error "PB109: smaller than the cutter";
    110 OffPlane "off-plane" Error "PB110: Z not 0";
    111 UnsupportedCurve "unsupported-curve" Warning "PB111: a curve on a path layer that is left out";
    112 LayerNotVisible "layer-not-visible" Warning "PB112: path layer frozen or off";
    113 WrongUnits "wrong-units" Error "PB113: units other than millimetres";
    114 TurnMarkerWithoutEffect "turn-marker-without-effect" Warning "PB114: turn marker without effect";
    115 JoinedEnds "joined-ends" Warning "PB115: ends joined within join-tolerance";
    116 DoubtfulText "doubtful-text" Warning "PB116: a text that nearly belongs to another element";
    117 InvalidKeepOut "invalid-keep-out" Error "PB117: a clamp whose outline or height is not clear";
    118 NearlyDrilled "nearly-drilled" Warning "PB118: a circle hardly larger than the cutter";
    119 TextOnOtherLayer "text-on-other-layer" Warning "PB119: a parameter text on a layer that is no path";
    120 NearlyPathLayer "nearly-path-layer" Warning "PB120: a layer that is nearly a path layer";
    121 LeftoverElement "leftover-element" Warning "PB121: a line without length, or a circle on another one";
    201 MissingParameter "missing-parameter" Error "PB201: needed, neither given nor inherited";
    202 UnknownParameter "unknown-parameter" Error "PB202: letter not known for this element";
    203 ParameterOutOfRange "parameter-out-of-range" Error "PB203: a value against its limits";
    204 DuplicateParameter "duplicate-parameter" Error "PB204: duplicate parameter";
    205 NotANumber "not-a-number" Error "PB205: not a number";
    206 VariableNotAllowed "variable-not-allowed" Error "PB206: a variable in N, O or @";
    207 MissingPathParameters "missing-path-parameters" Error "PB207: start marker without a text";
    208 InvalidAtReference "invalid-at-reference" Error "PB208: @ with other letters, to no path, or to a path that uses @";
    209 InvalidRegex "invalid-regex" Error "PB209: E is no regular expression";
    210 ParameterWithoutEffect "parameter-without-effect" Warning "PB210: parameter without effect";
    211 DoubtfulValue "doubtful-value" Warning "PB211: a value that is allowed and unlikely: B, D, I, F or W";
    212 LostBars "lost-bars" Warning "PB212: support bars described, but none drawn";
    301 InvalidVariableDefinition "invalid-variable-definition" Error "PB301: invalid variable definition";
    302 MissingVariableValue "missing-variable-value" Error "PB302: missing variable value";
    303 UnknownVariable "unknown-variable" Error "PB303: value without definition, or reference to none";
    304 VariableValueNotAllowed "variable-value-not-allowed" Error "PB304: variable value not allowed";
    305 EndlessVariable "endless-variable" Error "PB305: endless variable";
    401 NothingContinues "nothing-continues" Error "PB401: nothing continues";
    402 UnreachedSegments "unreached-segments" Error "PB402: unreached segments";
    403 EndNotReached "end-not-reached" Error "PB403: end not reached";
    404 EmptyPath "empty-path" Error "PB404: empty path";
    405 HelixTooLarge "helix-too-large" Error "PB405: a helical circle larger than A";
    406 NoRoomBetweenBars "no-room-between-bars" Error "PB406: the cutter does not fit between two support bars";
    407 InsideKeepOut "inside-keep-out" Error "PB407: the tool comes into a clamp";
    408 NoGapBetweenBars "no-gap-between-bars" Warning "PB408: support bars without a gap: the whole segment is left standing";
    501 MissingSubpathName "missing-subpath-name" Error "PB501: missing subpath name";
    502 InvalidPathName "invalid-path-name" Error "PB502: invalid path name";
    503 PathNotFound "path-not-found" Error "PB503: path not found";
    504 PathDefinedTwice "path-defined-twice" Error "PB504: path defined twice";
    505 SubpathSizeDiffers "subpath-size-differs" Error "PB505: subpath size differs";
    506 SubpathParameterDiffers "subpath-parameter-differs" Error "PB506: T, O or M of segment and path differ";
    507 SubpathForbidden "subpath-forbidden" Error "PB507: forbidden by E or --restrict";
    508 NestingTooDeep "nesting-too-deep" Error "PB508: nesting too deep";
    509 SubpathCycle "subpath-cycle" Error "PB509: subpath cycle";
    510 PathTBelowSubpathT "path-t-below-subpath-t" Error "PB510: path t below subpath t";
    511 SubpathHasErrors "subpath-has-errors" Error "PB511: an embedded path has errors of its own";
    512 SeveralPaths "several-paths" Error "PB512: a file is emitted that holds more than one path and none is named";
    513 NoPath "no-path" Error "PB513: a file is emitted, or named for checking, that holds no path";
    514 SameOutput "same-output" Error "PB514: two outputs would get one name";
    515 QProjectLacksPath "q-project-lacks-path" Warning "PB515: a Q-project lacks a path of its drawing";
    516 QProjectDiffers "q-project-differs" Warning "PB516: a subpath text of a Q-project differs from the proxy line";
    517 ProxyDiffers "proxy-differs" Error "PB517: a proxy line disagrees with its own path";
    518 NothingFound "nothing-found" Error "PB518: nothing to look at: no drawing, or no path in any drawing";
    519 PromisedPath "promised-path" Warning "PB519: the file's name names a path that no layer has";
    520 StaleOutput "stale-output" Warning "PB520: stale output";
    521 StrayPath "stray-path" Warning "PB521: a path that is not looked for in a file of this name";
    522 OlderOutput "older-output" Warning "PB522: a program of before the path became wrong";
    601 InvalidProbeLine "invalid-probe-line" Error "PB601: invalid probe line";
    602 CorrectionTooLarge "correction-too-large" Error "PB602: correction too large";
    603 UnknownProbe "unknown-probe" Error "PB603: unknown probe";
    604 InvalidFormula "invalid-formula" Error "PB604: invalid formula";
    605 ProbeValuesPresent "probe-values-present" Error "PB605: _Z.txt with values would be overwritten";
    606 OutsideProbes "outside-probes" Warning "PB606: milling outside the hull of the probes";
    607 OddProbe "odd-probe" Warning "PB607: a probe that does not fit its neighbours";
    608 OldProgram "old-program" Error "PB608: a program to be adjusted that is not what its drawing gives now";
    609 UnusedProbe "unused-probe" Error "PB609: a probe that no formula uses";
    701 NotGCode "not-g-code" Error "PB701: a file that holds no G-code at all";
    702 UnknownCharacter "unknown-character" Error "PB702: a character that begins no word";
    703 InvalidWord "invalid-word" Error "PB703: a letter without a number, or a number that is none";
    704 InvalidComment "invalid-comment" Error "PB704: a comment that is not closed, or within another";
    705 InvalidExpression "invalid-expression" Error "PB705: an expression or a parameter that cannot be read";
    706 LongLine "long-line" Error "PB706: a line longer than the control takes";
    707 DoubtfulSpelling "doubtful-spelling" Warning "PB707: a spelling that the dialect is not known to take, or that reads otherwise than it looks";
    708 RealTimeCharacter "real-time-character" Error "PB708: a character that the control obeys at once, even in a comment";
    709 AfterProgramEnd "after-program-end" Warning "PB709: lines behind the program's end";
    710 NoProgramEnd "no-program-end" Warning "PB710: a program that ends without M2, M30 or %";
    711 OptionalLine "optional-line" Warning "PB711: a line that a switch at the machine can leave out";
    720 UnknownWord "unknown-word" Error "PB720: a word that the dialect does not accept";
    721 WordNotFollowed "word-not-followed" Error "PB721: a word that the dialect accepts and pathbuild cannot follow";
    722 IgnoredWord "ignored-word" Warning "PB722: a word that the dialect passes over";
    723 ConflictingWords "conflicting-words" Error "PB723: words that exclude each other in one line";
    724 MissingWord "missing-word" Error "PB724: a word that another needs is not there";
    725 ValueOutOfRange "value-out-of-range" Error "PB725: a value that its word cannot have";
    726 UnusedWord "unused-word" Error "PB726: a word that nothing in its line uses";
    727 CannotEvaluate "cannot-evaluate" Error "PB727: an expression without a value";
    728 MachineValue "machine-value" Warning "PB728: a value that only the machine knows";
    729 UnknownOffset "unknown-offset" Warning "PB729: a coordinate system or position whose offset is not known here";
    730 UnitsNotStated "units-not-stated" Warning "PB730: no unit before the first move, or a contradictory one";
    731 ModesNotStated "modes-not-stated" Warning "PB731: distance mode or plane not stated before the first move";
    732 MotionNotStated "motion-not-stated" Warning "PB732: coordinates without a motion word where the dialect is not known to repeat it";
    733 MissingFeed "missing-feed" Error "PB733: a cutting move without feed, or with feed 0";
    734 ArcRadiiDiffer "arc-radii-differ" Error "PB734: an arc whose ends have different radii";
    735 InvalidArc "invalid-arc" Error "PB735: an arc that cannot be";
    736 DoubtfulArc "doubtful-arc" Warning "PB736: an arc that the last digit of its numbers turns into another";
    737 StopBeforeMotion "stop-before-motion" Warning "PB737: M5 or M9 in the line of a move, which most controls obey before it";
    738 UselessProbe "useless-probe" Warning "PB738: a probing move that cannot meet anything";
    739 MovesDiffer "moves-differ" Error "PB739: two programs that should move alike do not";
    740 RapidInMaterial "rapid-in-material" Error "PB740: a rapid move through material that is still there";
    741 RapidPlunge "rapid-plunge" Error "PB741: a rapid move down into material";
    742 StartNotRaised "start-not-raised" Warning "PB742: a move in the plane before the cutter is known to be above the material";
    743 EndNotRaised "end-not-raised" Warning "PB743: the program ends with the cutter in the material";
    744 DiagonalRapid "diagonal-rapid" Warning "PB744: a rapid move in the plane and down at once below the material's surface";
    745 SpindleOff "spindle-off" Error "PB745: cutting with the spindle off, in a program that switches it";
    746 SpindleSpeed "spindle-speed" Error "PB746: a spindle speed outside the machine's range";
    747 FeedTooHigh "feed-too-high" Warning "PB747: a feed above the machine's";
    748 OutsideMachine "outside-machine" Error "PB748: a move outside the machine's travel";
    749 ToolChangeAtDepth "tool-change-at-depth" Error "PB749: a tool change with the cutter in the material";
    750 InvalidPost "invalid-post" Error "PB750: a post-processor definition is broken, or an option in it is wrong";
    751 UnknownMacro "unknown-macro" Error "PB751: a macro or variable that nobody defines";
    752 DoubtfulPost "doubtful-post" Warning "PB752: a definition, or what it writes, is doubtful";
    753 EndlessMacro "endless-macro" Error "PB753: macros that contain each other, or come to too much text";
    754 MissingPostValue "missing-post-value" Error "PB754: a post asks for a value that the program does not have";
    755 LostDrilling "lost-drilling" Error "PB755: a hole that the post would not drill";
    756 RoundedArc "rounded-arc" Error "PB756: an arc whose rounded numbers are no circle any more";
    757 FlattenedArc "flattened-arc" Warning "PB757: an arc that the post turns into a line far from it";
    758 UnreadableLine "unreadable-line" Warning "PB758: a line of the post's output that is no G-code";
    759 InvalidControlText "invalid-control-text" Error "PB759: a control text is broken, or cannot be worked out";
    760 DoubtfulControlText "doubtful-control-text" Warning "PB760: a control text does what was hardly meant";
    761 InjectedFile "injected-file" Error "PB761: a file that a control text inserts is missing or lies elsewhere";
    762 RejectedWord "rejected-word" Error "PB762: the output has words or characters that the target's dialect rejects";
    763 LineTooLong "line-too-long" Error "PB763: a line of the output is longer than the target's dialect accepts";
    764 UnknownTool "unknown-tool" Warning "PB764: the tool table has no cutter for a path";
    765 NothingToPost "nothing-to-post" Error "PB765: a program that a post cannot write: empty, or with numbers that are none";
    766 UnknownPost "unknown-post" Error "PB766: no post-processor of that name";
    767 PostDiffers "post-differs" Error "PB767: what a post wrote, read back, does not move as the program does";
    768 PostBuildFailed "post-build-failed" Error "PB768: the command that a post names does not run, or fails";
    769 UncorrectedHeights "uncorrected-heights" Error "PB769: a program whose heights are still to be corrected would be written through a post";
    770 SpindleLeftOn "spindle-left-on" Warning "PB770: a program that ends with the spindle turning";
    771 CoarseArcs "coarse-arcs" Warning "PB771: arcs in millimetres with fewer than three decimals";
    772 ProbeNotRaised "probe-not-raised" Warning "PB772: a move in the plane straight after a probe has met something";
    773 ActiveComment "active-comment" Warning "PB773: a comment that the control obeys";
    774 OffsetLeftOn "offset-left-on" Warning "PB774: an offset (G52, G92) that still holds at the end";
    775 FormulaDiffers "formula-differs" Error "PB775: a height that is not what its correction formula comes to, or a formula that is not the drawing's";
    776 UncheckedFormula "unchecked-formula" Error "PB776: a correction formula whose probes or measured heights the program does not state, or a height that lacks one";
    777 Disagreement "disagreement" Warning "PB777: two places say different things: header and tool table, option and drawing, comments and moves";
    778 ForeignWord "foreign-word" Warning "PB778: a word that the post does not write and that is not followed";
}

impl Code {
    /// Whether the configuration may lower its severity. Errors that would make a program wrong cannot be lowered. (book:
    /// reference/configuration)
    pub fn can_be_lowered(self) -> bool {
        self.severity() == Severity::Warning || self.number() >= 600
    }
}

/// Displays as `PB203`.
impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "PB{:03}", self.number())
    }
}

/// Parses `PB203` in any case, or the readable name.
impl FromStr for Code {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let is_it = |code: &&Self| code.to_string().eq_ignore_ascii_case(text) || code.name() == text;
        Self::ALL.iter().find(is_it).copied().ok_or(())
    }
}
