//! The words for what was changed in a drawing, and why a path's moves therefore differ. (book: program/comparing)

use crate::words::words;

words! {
    /// A start marker. A path has one.
    START: "start marker", "Anfangsmarke";
    /// An end marker. A path has one.
    END: "end marker", "Endmarke";
    /// A turn marker.
    TURN: "turn marker at {point}", "Wendemarke bei {point}";
    /// Turn markers.
    TURNS: "{count} turn markers, the first at {point}", "{count} Wendemarken, die erste bei {point}";
    /// A Z-probe.
    PROBE: "Z-probe at {point}", "Z-Probe bei {point}";
    /// Z-probes.
    PROBES: "{count} Z-probes, the first at {point}", "{count} Z-Proben, die erste bei {point}";
    /// A circle.
    CIRCLE: "circle at {point}", "Kreis bei {point}";
    /// Circles.
    CIRCLES: "{count} circles, the first at {point}", "{count} Kreise, der erste bei {point}";
    /// A line.
    LINE: "line at {point}", "Linie bei {point}";
    /// Lines.
    LINES: "{count} lines, the first at {point}", "{count} Linien, die erste bei {point}";
    /// An arc.
    ARC: "arc at {point}", "Bogen bei {point}";
    /// Arcs.
    ARCS: "{count} arcs, the first at {point}", "{count} Bögen, der erste bei {point}";
    /// The element is new.
    ADDED: "{what}: added", "{what}: dazugekommen";
    /// The element is gone.
    REMOVED: "{what}: removed", "{what}: weggefallen";
    /// The element is elsewhere.
    MOVED: "{what}: moved by {by} mm", "{what}: um {by} mm verschoben";
    /// An end of the element is elsewhere.
    END_MOVED: "{what}: one end moved by {by} mm", "{what}: ein Ende um {by} mm verschoben";
    /// The element has another shape.
    RESHAPED: "{what}: runs differently", "{what}: anderer Verlauf";
    /// A circle has another diameter.
    DIAMETER: "{what}: diameter {was} became {now}", "{what}: aus Durchmesser {was} wurde {now}";
    /// An arc has another radius.
    RADIUS: "{what}: radius {was} became {now}", "{what}: aus Radius {was} wurde {now}";
    /// The element has another line type.
    LINE_TYPE: "{what}: line type changed from {was} to {now}", "{what}: Linientyp von {was} in {now} geändert";
    /// Parameters in the element's text differ.
    TEXT: "{what}: text {was} became {now}", "{what}: aus dem Text {was} wurde {now}";
    /// The element's text has further parameters.
    TEXT_ADDED: "{what}: text {now} added", "{what}: Text {now} dazugekommen";
    /// The element's text has fewer parameters.
    TEXT_REMOVED: "{what}: text {was} removed", "{what}: Text {was} weggefallen";
    /// A variable has another value.
    VARIABLE: "variable {name}: {was} became {now}", "Variable {name}: aus {was} wurde {now}";
    /// A key of the configuration has another value that the path uses.
    SETTING: "{name} in pathbuild.toml: {was} became {now}", "{name} in pathbuild.toml: aus {was} wurde {now}";
    /// A variable or a key that has no value.
    NOT_SET: "not set", "nicht gesetzt";
    /// An embedded path differs; what was changed in it follows.
    EMBEDDED: "embedded {path} changed", "eingebetteter Pfad {path} geändert";
    /// An embedded path differs that was mentioned before.
    EMBEDDED_AGAIN: "embedded {path} changed, as above", "eingebetteter Pfad {path} geändert, wie oben";
    /// The same elements come after each other otherwise.
    REORDERED: "the same elements, in another order in the file", "dieselben Elemente, in anderer Reihenfolge in der Datei";
}
