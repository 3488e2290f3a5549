//! Messages about variables: definitions, values, references. (PB301 to PB305)

messages! {
    /// A malformed definition.
    INVALID_DEFINITION: InvalidVariableDefinition {
        en: "\"{definition}\" does not define the values of a variable",
        de: "\"{definition}\" legt keine Variablenwerte fest",
        help_en: "a range (:A-0.5~1.2), a list (:BP1,P2,P3) or single characters (:C?PQRS)",
        help_de: "ein Bereich (:A-0.5~1.2), eine Liste (:BP1,P2,P3) oder einzelne Zeichen (:C?PQRS)",
    }
    /// A range from a greater to a lesser number.
    REVERSED_RANGE: InvalidVariableDefinition {
        en: "the range \"{definition}\" ends below its beginning",
        de: "der Bereich \"{definition}\" endet unter seinem Anfang",
        help_en: "write the smaller number first",
        help_de: "die kleinere Zahl zuerst schreiben",
    }
    /// A list with an empty element.
    EMPTY_ELEMENT: InvalidVariableDefinition {
        en: "\"{definition}\" has an empty element",
        de: "\"{definition}\" hat ein leeres Element",
        help_en: "remove the comma, or write the value between",
        help_de: "das Komma entfernen oder den Wert dazwischenschreiben",
    }
    /// A path with variables that is emitted on its own.
    MISSING_VALUE: MissingVariableValue {
        en: "variable \"{variable}\" has no value",
        de: "Variable \"{variable}\" hat keinen Wert",
        help_en: "it is defined as {definition}; embed the path in a project that sets it: :{variable}VALUE",
        help_de: "sie ist als {definition} festgelegt; den Pfad in ein Projekt einbetten, das sie setzt: :{variable}WERT",
    }
    /// A subpath that does not set a variable of its path.
    MISSING_VALUE_HERE: MissingVariableValue {
        en: "variable \"{variable}\" of path {name} has no value",
        de: "Variable \"{variable}\" des Pfads {name} hat keinen Wert",
        help_en: "add it here, for example :{variable}{example}; the path defines it as {definition}",
        help_de: "hier hinzufügen, zum Beispiel :{variable}{example}; der Pfad legt sie als {definition} fest",
    }
    /// A subpath that sets an unknown variable.
    VALUE_WITHOUT_DEFINITION: UnknownVariable {
        en: "path {name} has no variable \"{variable}\"",
        de: "Pfad {name} hat keine Variable \"{variable}\"",
        help_en: "it has {known}",
        help_de: "er hat {known}",
    }
    /// A reference to an unknown variable.
    UNKNOWN_REFERENCE: UnknownVariable {
        en: "there is no variable \"{variable}\" in this path",
        de: "es gibt in diesem Pfad keine Variable \"{variable}\"",
        help_en: "the path's start marker defines {known}; a reference is = and one character",
        help_de: "die Anfangsmarke des Pfads legt {known} fest; ein Verweis ist = und ein Zeichen",
    }
    /// An equals sign after a letter: B=2 instead of B2.
    EQUALS_SIGN: UnknownVariable {
        en: "there is no variable \"{variable}\" in this path",
        de: "es gibt in diesem Pfad keine Variable \"{variable}\"",
        help_en: "write \"{meant}\" for the number: values follow their letter directly, and = puts in a variable",
        help_de: "für die Zahl \"{meant}\" schreiben: Werte folgen direkt auf ihren Buchstaben, und = setzt eine Variable ein",
    }
    /// A value that the definition does not permit.
    VALUE_NOT_ALLOWED: VariableValueNotAllowed {
        en: "variable \"{variable}\" cannot be \"{value}\"",
        de: "Variable \"{variable}\" kann nicht \"{value}\" sein",
        help_en: "path {name} defines it as {definition}",
        help_de: "Pfad {name} legt sie als {definition} fest",
    }
    /// A cyclic reference.
    ENDLESS: EndlessVariable {
        en: "the value of \"{variable}\" refers to itself",
        de: "der Wert von \"{variable}\" verweist auf sich selbst",
        help_en: "a value may refer to other variables, but not in a circle",
        help_de: "ein Wert darf auf andere Variablen verweisen, aber nicht im Kreis",
    }
    /// More combinations of values than are checked.
    COMBINATIONS_CUT: LimitReached {
        en: "{checked} of {all} combinations of the variables' values were checked",
        de: "{checked} von {all} Kombinationen der Variablenwerte wurden geprüft",
        help_en: "each value was in one of them at least; projects are checked with the values that they set",
        help_de: "jeder Wert kam in mindestens einer vor; Projekte werden mit den Werten geprüft, die sie setzen",
    }
    /// Note: the values of the variables for which this was found.
    WITH_VALUES: VariableValueNotAllowed {
        en: "with {values} in path {name}",
        de: "mit {values} in Pfad {name}",
    }
    /// Note: the values of the variables for which this was found, and the number of others.
    WITH_MORE_VALUES: VariableValueNotAllowed {
        en: "with {values} in path {name}, and with {others} more of {all} combinations",
        de: "mit {values} in Pfad {name}, und mit {others} weiteren von {all} Kombinationen",
    }
    /// References that are nested too deeply; they may be cyclic.
    TOO_DEEP: EndlessVariable {
        en: "the value of \"{variable}\" refers to itself, or values refer to others more than {limit} deep",
        de: "der Wert von \"{variable}\" verweist auf sich selbst, oder Werte verweisen mehr als {limit} tief auf andere",
        help_en: "a value may refer to other variables, but not in a circle; write long chains of them as one value",
        help_de: "ein Wert darf auf andere Variablen verweisen, aber nicht im Kreis; lange Ketten davon als einen Wert schreiben",
    }
}
