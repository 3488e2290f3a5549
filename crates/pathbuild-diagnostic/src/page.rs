use crate::{Code, Lang};

/// Declares the pages: `PBnnn.en.md`, `PBnnn.de.md` and, if there is one, the example `PBnnn.draw`, which is rendered as a table at the end
/// of both (tests/cli/book/examples.rs).
macro_rules! pages {
    ($($code:ident $file:literal $($example:ident)?;)*) => {
        /// The page that `pathbuild explain` prints for a code, as Markdown: meaning, usual causes, remedy, example. `None` for a code
        /// without a page.
        pub fn page(code: Code, lang: Lang) -> Option<&'static str> {
            match (code, lang) {
                $((Code::$code, Lang::En) => Some(include_str!(concat!("pages/", $file, ".en.md"))),
                (Code::$code, Lang::De) => Some(include_str!(concat!("pages/", $file, ".de.md"))),)*
                #[allow(unreachable_patterns, reason = "codes may be added before their pages")]
                _ => None,
            }
        }

        /// The example on the page of a code: a fixture (crates/pathbuild-testkit) whose commands give exactly the noted diagnostics.
        /// `None` if the problem cannot be shown in a few lines.
        pub fn example(code: Code) -> Option<&'static str> {
            match code {
                $($(Code::$code => Some(drawn!($example $file)),)?)*
                _ => None,
            }
        }
    };
}

macro_rules! drawn {
    (example $file:literal) => {
        include_str!(concat!("pages/", $file, ".draw"))
    };
}

pages! {
    UnreadableFile "PB001" example;
    InvalidDxf "PB002" example;
    InvalidConfiguration "PB003" example;
    CannotWrite "PB004" example;
    LimitReached "PB005" example;
    InternalError "PB006";
    NoEndOfFile "PB007" example;
    DoubtfulEncoding "PB008" example;
    MissingStart "PB101" example;
    MissingEnd "PB102" example;
    TwoStarts "PB103" example;
    TwoEnds "PB104" example;
    UnknownSpecialCircle "PB105" example;
    UnknownLineType "PB106" example;
    TextWithoutElement "PB107" example;
    CircleTooSmall "PB109" example;
    OffPlane "PB110" example;
    UnsupportedCurve "PB111" example;
    LayerNotVisible "PB112" example;
    WrongUnits "PB113" example;
    TurnMarkerWithoutEffect "PB114" example;
    JoinedEnds "PB115" example;
    DoubtfulText "PB116" example;
    InvalidKeepOut "PB117" example;
    NearlyDrilled "PB118" example;
    TextOnOtherLayer "PB119" example;
    NearlyPathLayer "PB120" example;
    LeftoverElement "PB121" example;
    MissingParameter "PB201" example;
    UnknownParameter "PB202" example;
    ParameterOutOfRange "PB203" example;
    DuplicateParameter "PB204" example;
    NotANumber "PB205" example;
    VariableNotAllowed "PB206" example;
    MissingPathParameters "PB207" example;
    InvalidAtReference "PB208" example;
    InvalidRegex "PB209" example;
    ParameterWithoutEffect "PB210" example;
    DoubtfulValue "PB211" example;
    LostBars "PB212" example;
    InvalidVariableDefinition "PB301" example;
    MissingVariableValue "PB302" example;
    UnknownVariable "PB303" example;
    VariableValueNotAllowed "PB304" example;
    EndlessVariable "PB305" example;
    NothingContinues "PB401" example;
    UnreachedSegments "PB402" example;
    EndNotReached "PB403" example;
    EmptyPath "PB404" example;
    HelixTooLarge "PB405" example;
    NoRoomBetweenBars "PB406" example;
    InsideKeepOut "PB407" example;
    NoGapBetweenBars "PB408" example;
    MissingSubpathName "PB501" example;
    InvalidPathName "PB502" example;
    PathNotFound "PB503" example;
    PathDefinedTwice "PB504" example;
    SubpathSizeDiffers "PB505" example;
    SubpathParameterDiffers "PB506" example;
    SubpathForbidden "PB507" example;
    NestingTooDeep "PB508" example;
    SubpathCycle "PB509" example;
    PathTBelowSubpathT "PB510" example;
    SubpathHasErrors "PB511" example;
    SeveralPaths "PB512" example;
    NoPath "PB513" example;
    SameOutput "PB514" example;
    QProjectLacksPath "PB515" example;
    QProjectDiffers "PB516" example;
    ProxyDiffers "PB517" example;
    NothingFound "PB518" example;
    PromisedPath "PB519" example;
    StaleOutput "PB520" example;
    StrayPath "PB521" example;
    OlderOutput "PB522" example;
    InvalidProbeLine "PB601" example;
    CorrectionTooLarge "PB602" example;
    UnknownProbe "PB603" example;
    InvalidFormula "PB604" example;
    ProbeValuesPresent "PB605" example;
    OutsideProbes "PB606" example;
    OddProbe "PB607" example;
    OldProgram "PB608" example;
    UnusedProbe "PB609" example;
    NotGCode "PB701" example;
    UnknownCharacter "PB702" example;
    InvalidWord "PB703" example;
    InvalidComment "PB704" example;
    InvalidExpression "PB705" example;
    LongLine "PB706" example;
    DoubtfulSpelling "PB707" example;
    RealTimeCharacter "PB708" example;
    AfterProgramEnd "PB709" example;
    NoProgramEnd "PB710" example;
    OptionalLine "PB711" example;
    UnknownWord "PB720" example;
    WordNotFollowed "PB721" example;
    IgnoredWord "PB722" example;
    ConflictingWords "PB723" example;
    MissingWord "PB724" example;
    ValueOutOfRange "PB725" example;
    UnusedWord "PB726" example;
    CannotEvaluate "PB727" example;
    MachineValue "PB728" example;
    UnknownOffset "PB729" example;
    UnitsNotStated "PB730" example;
    ModesNotStated "PB731" example;
    MotionNotStated "PB732" example;
    MissingFeed "PB733" example;
    ArcRadiiDiffer "PB734" example;
    InvalidArc "PB735" example;
    DoubtfulArc "PB736" example;
    StopBeforeMotion "PB737" example;
    UselessProbe "PB738" example;
    MovesDiffer "PB739" example;
    RapidInMaterial "PB740" example;
    RapidPlunge "PB741" example;
    StartNotRaised "PB742" example;
    EndNotRaised "PB743" example;
    DiagonalRapid "PB744" example;
    SpindleOff "PB745" example;
    SpindleSpeed "PB746" example;
    FeedTooHigh "PB747" example;
    OutsideMachine "PB748" example;
    ToolChangeAtDepth "PB749" example;
    InvalidPost "PB750" example;
    UnknownMacro "PB751" example;
    DoubtfulPost "PB752" example;
    EndlessMacro "PB753" example;
    MissingPostValue "PB754" example;
    LostDrilling "PB755" example;
    RoundedArc "PB756" example;
    FlattenedArc "PB757" example;
    UnreadableLine "PB758" example;
    InvalidControlText "PB759" example;
    DoubtfulControlText "PB760" example;
    InjectedFile "PB761" example;
    RejectedWord "PB762" example;
    LineTooLong "PB763" example;
    UnknownTool "PB764" example;
    NothingToPost "PB765" example;
    UnknownPost "PB766" example;
    PostDiffers "PB767" example;
    PostBuildFailed "PB768" example;
    UncorrectedHeights "PB769" example;
    SpindleLeftOn "PB770" example;
    CoarseArcs "PB771" example;
    ProbeNotRaised "PB772" example;
    ActiveComment "PB773" example;
    OffsetLeftOn "PB774" example;
    FormulaDiffers "PB775" example;
    UncheckedFormula "PB776" example;
    Disagreement "PB777" example;
    ForeignWord "PB778" example;
    UnnamedDialect "PB779" example;
}
