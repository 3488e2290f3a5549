//! Messages about the content of DXF files: structure, values, encoding, and ignored entities. (PB002, PB007, PB008, PB110 to PB112)

messages! {
    /// A line that is not a group code.
    BAD_GROUP_CODE: InvalidDxf {
        en: "expected a group code here, not \"{found}\"",
        de: "hier wird ein Gruppencode erwartet, nicht \"{found}\"",
        help_en: "a line was lost, or a text holds a line break: from here on codes and values are out of step; save the drawing again",
        help_de: "eine Zeile fehlt, oder ein Text enthält einen Zeilenumbruch: ab hier passen Codes und Werte nicht zusammen; die Zeichnung noch einmal speichern",
    }
    /// A file that ends inside a section.
    TRUNCATED: InvalidDxf {
        en: "the file is cut off in section {section}",
        de: "die Datei bricht im Abschnitt {section} ab",
        help_en: "save the drawing again; perhaps the CAD is still writing it, or it was copied only in part",
        help_de: "die Zeichnung noch einmal speichern; vielleicht schreibt das CAD noch, oder sie wurde nur teilweise kopiert",
    }
    /// A file without an ENTITIES section and without an end.
    NO_ENTITIES: InvalidDxf {
        en: "the file ends before the section ENTITIES",
        de: "die Datei endet vor dem Abschnitt ENTITIES",
        help_en: "save the drawing again; perhaps the CAD is still writing it, or it was copied only in part",
        help_de: "die Zeichnung noch einmal speichern; vielleicht schreibt das CAD noch, oder sie wurde nur teilweise kopiert",
    }
    /// A section without an end.
    SECTION_NOT_ENDED: InvalidDxf {
        en: "section {section} has no end: \"{found}\" stands where ENDSEC is missing",
        de: "der Abschnitt {section} hat kein Ende: vor \"{found}\" fehlt ENDSEC",
        help_en: "the file is broken; save the drawing again",
        help_de: "die Datei ist beschädigt; die Zeichnung noch einmal speichern",
    }
    /// Something between two sections.
    SECTION_EXPECTED: InvalidDxf {
        en: "expected a section or the end of the file here, not \"{found}\"",
        de: "hier wird ein Abschnitt oder das Ende der Datei erwartet, nicht \"{found}\"",
        help_en: "the file is broken; save the drawing again",
        help_de: "die Datei ist beschädigt; die Zeichnung noch einmal speichern",
    }
    /// A value that is not a number.
    VALUE_NOT_A_NUMBER: InvalidDxf {
        en: "{entity}: group {code} must be a number, not \"{value}\"",
        de: "{entity}: Gruppe {code} muss eine Zahl sein, nicht \"{value}\"",
        help_en: "the program that wrote the file wrote a broken entity; draw it anew, or save the drawing again",
        help_de: "das Programm, das die Datei schrieb, hat ein beschädigtes Element geschrieben; das Element neu zeichnen oder die Zeichnung noch einmal speichern",
    }
    /// A decimal comma.
    DECIMAL_COMMA: InvalidDxf {
        en: "{entity}: \"{value}\" in group {code} has a decimal comma, DXF numbers have a point",
        de: "{entity}: \"{value}\" in Gruppe {code} hat ein Dezimalkomma, DXF-Zahlen haben einen Punkt",
        help_en: "the program that wrote the file uses the system's number format; set that to a decimal point for it",
        help_de: "das Programm, das die Datei schrieb, verwendet das Zahlenformat des Systems; dort den Dezimalpunkt einstellen",
    }
    /// A number that is not finite: nan, inf, 1e400.
    NUMBER_NOT_FINITE: InvalidDxf {
        en: "{entity}: \"{value}\" in group {code} is not a finite number",
        de: "{entity}: \"{value}\" in Gruppe {code} ist keine endliche Zahl",
        help_en: "the program that wrote the file wrote a broken entity; draw it anew",
        help_de: "das Programm, das die Datei schrieb, hat ein beschädigtes Element geschrieben; das Element neu zeichnen",
    }
    /// A missing group.
    GROUP_MISSING: InvalidDxf {
        en: "{entity}: group {code} is missing",
        de: "{entity}: Gruppe {code} fehlt",
        help_en: "the entity is incomplete; draw it anew, or save the drawing again",
        help_de: "das Element ist unvollständig; das Element neu zeichnen oder die Zeichnung noch einmal speichern",
    }
    /// A length that must be positive.
    NOT_POSITIVE: InvalidDxf {
        en: "{entity}: \"{value}\" in group {code} must be more than 0",
        de: "{entity}: \"{value}\" in Gruppe {code} muss größer als 0 sein",
        help_en: "the entity has no extent; delete it or draw it anew",
        help_de: "das Element hat keine Ausdehnung; löschen oder neu zeichnen",
    }
    /// A coordinate or length that is too large, or a length of zero.
    TOO_LARGE: InvalidDxf {
        en: "{entity} lies or reaches more than 1,000,000 mm from the origin, or its size is 0",
        de: "{entity} liegt oder reicht weiter als 1.000.000 mm vom Nullpunkt, oder seine Größe ist 0",
        help_en: "draw near the origin, at true size: move the entity, or the block that it is in, or delete it",
        help_de: "nahe am Nullpunkt und in wahrer Größe zeichnen: das Element oder seinen Block verschieben oder löschen",
    }
    /// An extrusion direction other than (0,0,1) and (0,0,-1).
    TILTED: OffPlane {
        en: "{entity} lies in a tilted plane",
        de: "{entity} liegt in einer gekippten Ebene",
        help_en: "draw it in the plane of the drawing: in the world coordinate system, with an extrusion of 0,0,1",
        help_de: "in der Zeichenebene zeichnen: im Weltkoordinatensystem, mit der Extrusion 0,0,1",
    }
    /// A file without EOF.
    NO_END_OF_FILE: NoEndOfFile {
        en: "the file does not end with EOF",
        de: "die Datei endet nicht mit EOF",
        help_en: "the entities were read, but perhaps the CAD is still writing the file; save the drawing again",
        help_de: "die Elemente wurden gelesen, aber vielleicht schreibt das CAD die Datei noch; die Zeichnung noch einmal speichern",
    }
    /// Bytes that are invalid in the encoding.
    UNDECODABLE: DoubtfulEncoding {
        en: "the file is in {encoding}, which does not know some bytes of this text",
        de: "die Datei ist in {encoding} geschrieben, das einige Bytes dieses Textes nicht kennt",
        help_en: "special characters of texts and layer names may be wrong; save the drawing as R2007 or later",
        help_de: "Sonderzeichen in Texten und Layernamen können falsch sein; die Zeichnung als R2007 oder neuer speichern",
    }
    /// An unknown code page.
    UNKNOWN_CODE_PAGE: DoubtfulEncoding {
        en: "the code page \"{encoding}\" is not known; texts are read as ANSI_1252",
        de: "die Codepage \"{encoding}\" ist nicht bekannt; Texte werden als ANSI_1252 gelesen",
        help_en: "special characters of texts and layer names may be wrong; save the drawing as R2007 or later",
        help_de: "Sonderzeichen in Texten und Layernamen können falsch sein; die Zeichnung als R2007 oder neuer speichern",
    }
    /// ELLIPSE or SPLINE without the setting for approximating them.
    NOT_APPROXIMATED: UnsupportedCurve {
        en: "{entity} is left out: only lines and arcs are milled",
        de: "{entity} wird ausgelassen: nur Linien und Bögen werden gefräst",
        help_en: "draw it with arcs, or set `approximate-curves` in pathbuild.toml to the largest deviation in mm that is allowed",
        help_de: "mit Bögen zeichnen oder `approximate-curves` in pathbuild.toml auf die größte erlaubte Abweichung in mm setzen",
    }
    /// Polylines, blocks and curves with `compatible`, reported once per drawing.
    NOT_COMPATIBLE: UnsupportedCurve {
        en: "polylines, blocks and curves on path layers are left out, as PathDxf2GCode does; the first is {entity}",
        de: "Polylinien, Blöcke und Kurven auf Pfad-Layern werden ausgelassen wie von PathDxf2GCode; die erste ist {entity}",
        help_en: "explode it into lines and arcs, or work without `compatible`, where it is milled",
        help_de: "in Linien und Bögen auflösen oder ohne `compatible` arbeiten: dann wird gefräst",
    }
    /// Three-dimensional polylines and meshes.
    POLYLINE_NOT_FLAT: UnsupportedCurve {
        en: "{entity} is left out: it is a 3D polyline or a mesh",
        de: "{entity} wird ausgelassen: es ist eine 3D-Polylinie oder ein Netz",
        help_en: "draw it as a 2D polyline, or with lines and arcs",
        help_de: "als 2D-Polylinie zeichnen oder mit Linien und Bögen",
    }
    /// A spline with fit points only, or with invalid knots.
    SPLINE_NOT_UNDERSTOOD: UnsupportedCurve {
        en: "{entity} is left out: its control points and knots do not describe a curve",
        de: "{entity} wird ausgelassen: Kontrollpunkte und Knoten beschreiben keine Kurve",
        help_en: "convert it to lines and arcs in the CAD",
        help_de: "im CAD in Linien und Bögen umwandeln",
    }
    /// An INSERT with different scales.
    INSERT_SCALED: UnsupportedCurve {
        en: "block {block} is left out: it is inserted with different scales in x and y",
        de: "Block {block} wird ausgelassen: er ist in x und y verschieden skaliert eingefügt",
        help_en: "explode it, or insert it with one scale",
        help_de: "auflösen oder mit einem einzigen Maßstab einfügen",
    }
    /// An INSERT of a missing block.
    BLOCK_MISSING: UnsupportedCurve {
        en: "block {block} is left out: the file does not contain it",
        de: "Block {block} wird ausgelassen: die Datei enthält ihn nicht",
        help_en: "bind external references before saving, or delete the insertion",
        help_de: "externe Referenzen vor dem Speichern binden oder die Einfügung löschen",
    }
    /// A block that contains itself or is nested too deeply.
    BLOCK_NESTED: InvalidDxf {
        en: "block {block} is nested too deep, or contains itself",
        de: "Block {block} ist zu tief verschachtelt oder enthält sich selbst",
        help_en: "explode the insertion",
        help_de: "die Einfügung auflösen",
    }
    /// An entity that is marked invisible.
    INVISIBLE: LayerNotVisible {
        en: "{entity} is marked invisible, but is used nevertheless",
        de: "{entity} ist als unsichtbar markiert, gilt aber trotzdem",
        help_en: "show all hidden objects in the CAD and delete what is not meant to be milled",
        help_de: "im CAD alle verborgenen Objekte anzeigen und löschen, was nicht gefräst werden soll",
    }
}
