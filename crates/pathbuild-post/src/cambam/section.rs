//! The named texts of a CamBam definition, and the defaults for absent ones.

use pathbuild_motion::{Coolant, Turning};

macro_rules! sections {
    ($($variant:ident $name:literal $default:expr;)*) => {
        /// A section of a definition, that is, an element that contains a template.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(super) enum Section {
            $($variant,)*
            /// The value of a user macro, which is stored like a section although it has no element of its own.
            UserMacro,
            /// The value of a user macro of the configuration, which has no position in the definition's file.
            ConfiguredMacro,
        }

        impl Section {
            /// All sections that a definition file can contain.
            pub(super) const ALL: &[Self] = &[$(Self::$variant,)*];

            /// Name of the element.
            pub(super) fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                    Self::UserMacro => "PostProcessorMacros",
                    Self::ConfiguredMacro => "[macros]",
                }
            }

            /// Whether the section contains entire lines instead of words within a line.
            pub(super) fn holds_lines(self) -> bool {
                use Section::{
                    ArcCcw, ArcCw, CannedCycleEnd, CannedCycleStart, ConfiguredMacro, Drill, DrillDwell, DrillPeck, Dwell,
                    EndCut, FeedMove, Footer, Header, Mop, PostFile, Probe, Rapid, StartCut, ToolChange,
                    ToolTableItem, UserMacro,
                };
                matches!(
                    self,
                    ArcCcw | ArcCw | CannedCycleEnd | CannedCycleStart | Drill | DrillDwell | DrillPeck
                        | Dwell | EndCut | FeedMove | Footer | Header | Mop | PostFile | Probe | Rapid | StartCut
                        | ToolChange | ToolTableItem | UserMacro | ConfiguredMacro
                )
            }

            /// Default text if the element is absent.
            pub(super) fn default_text(self) -> &'static str {
                match self {
                    $(Self::$variant => $default,)*
                    Self::UserMacro | Self::ConfiguredMacro => "",
                }
            }
        }
    };
}

sections! {
    PostFile "PostFile" "{$comment} Made using CamBam - http://www.cambam.co.uk {$endcomment}\n{$header}\n{$mops}\n{$footer}\n";
    Header "Header" HEADER;
    Footer "Footer" "{$clearance}\n{$spindle(off)}\n{$endrewind}\n{$cbfile.footer}\n";
    ToolTableItem "ToolTableItem" "{$comment} T{$tool.index} : {$tool.diameter} {$endcomment}";
    ToolChange "ToolChange" "{$clearance}\n{$comment} T{$tool.index} : {$tool.diameter} {$endcomment}\nT{$tool.index} M6";
    Mop "MOP" MOP;
    Rapid "Rapid" "{$g0} {$_f} {$_x} {$_y} {$_z} {$_a} {$_b} {$_c}";
    FeedMove "FeedMove" "{$g1} {$_f} {$_x} {$_y} {$_z} {$_a} {$_b} {$_c}";
    ArcCw "ArcCW" "{$g2} {$_f} {$_x} {$_y} {$_z} {$i} {$j} {$k}";
    ArcCcw "ArcCCW" "{$g3} {$_f} {$_x} {$_y} {$_z} {$i} {$j} {$k}";
    Drill "Drill" "{$g81} {$_x} {$_y} {$_z} {$_r} {$_f}";
    DrillDwell "DrillDwell" "{$g82} {$_x} {$_y} {$_z} {$p} {$_r} {$_f}";
    DrillPeck "DrillPeck" "{$g83} {$_x} {$_y} {$_z} {$_q} {$_r} {$_f}";
    CannedCycleStart "CannedCycleStart" "G98";
    CannedCycleEnd "CannedCycleEnd" "G80";
    G0 "G0" "G0";
    G1 "G1" "G1";
    G2 "G2" "G2";
    G3 "G3" "G3";
    G81 "G81" "G81";
    G82 "G82" "G82";
    G83 "G83" "G83";
    UnitsInches "UnitsInches" "G20";
    UnitsMm "UnitsMM" "G21";
    DistanceAbsolute "DistanceAbsolute" "G90";
    DistanceIncremental "DistanceIncremental" "G91";
    ArcCenterAbsolute "ArcCenterAbsolute" "G90.1";
    ArcCenterIncremental "ArcCenterIncremental" "G91.1";
    VelocityModeExactStop "VelocityModeExactStop" "G61";
    VelocityModeConstantVelocity "VelocityModeConstantVelocity" "G64";
    WorkPlaneXy "WorkPlaneXY" "G17";
    WorkPlaneXz "WorkPlaneXZ" "G18";
    WorkPlaneYz "WorkPlaneYZ" "G19";
    CutterCompOff "CutterCompOff" "G40";
    CutterCompLeft "CutterCompLeft" "G41";
    CutterCompRight "CutterCompRight" "G42";
    XModeDiameter "XModeDiameter" "G7";
    XModeRadius "XModeRadius" "G8";
    SpindleCw "SpindleCW" "M3";
    SpindleCcw "SpindleCCW" "M4";
    SpindleOff "SpindleOff" "M5";
    Stop "Stop" "M0";
    Repeat "Repeat" "M47";
    EndRewind "EndRewind" "M30";
    Comment "Comment" "(";
    EndComment "EndComment" ")";
    StartCut "StartCut" "";
    EndCut "EndCut" "";
    // The elements from here on are extensions of pathbuild. CamBam ignores unknown elements.
    CoolantFlood "CoolantFlood" "M8";
    CoolantMist "CoolantMist" "M7";
    CoolantOff "CoolantOff" "M9";
    Dwell "Dwell" "G4 {$p}";
    Probe "Probe" "G38.2 {$_f} {$x} {$y} {$z}";
}

const HEADER: &str = "{$comment} {$cbfile.name} {$date} {$endcomment}
{$tooltable}
{$cbfile.header}
{$units} {$distancemode} {$velocitymode} {$cuttercomp(off)}
{$toolchange(first)}
{$clearance}";

const MOP: &str = "{$comment} {$mop.name} {$endcomment}
{$toolchange}
{$velocitymode} {$workplane}
{$mop.header}
{$spindle} {$s}
{$blocks}
{$mop.footer}
";

impl Section {
    /// Whether the element is an extension of pathbuild, unknown to CamBam.
    pub(super) fn is_own(self) -> bool {
        matches!(self, Self::CoolantFlood | Self::CoolantMist | Self::CoolantOff | Self::Dwell | Self::Probe)
    }
}

pub(super) fn spindle_section(spindle: Turning) -> Section {
    match spindle {
        Turning::Clockwise => Section::SpindleCw,
        Turning::CounterClockwise => Section::SpindleCcw,
        Turning::Off | Turning::Unstated => Section::SpindleOff,
    }
}

pub(super) fn coolant_section(coolant: Coolant) -> Section {
    match coolant {
        Coolant { flood: true, .. } => Section::CoolantFlood,
        Coolant { mist: true, .. } => Section::CoolantMist,
        Coolant { .. } => Section::CoolantOff,
    }
}
