//! Registry of types that refer to each other.

use std::collections::{BTreeMap, BTreeSet};

use periplus_diagnostics::{Diagnostic, Diagnostics, FileId, SourceMap};

use crate::{
    ArrayShape, Definition, Interface, InterfaceDialect, SEPARATOR, TypeName, expand, parse,
};

/// Maximum number of elements in all fixed-size arrays of a type together: every value of the type needs
/// that much memory, whatever a message contains.
const MAX_FIXED_ELEMENTS: u64 = 1 << 20;

/// Maximum nesting depth; the deepest in common use is 7.
const MAX_DEPTH: usize = 64;

/// Types of many texts, by name.
#[derive(Clone, Debug, Default)]
pub struct Registry {
    types: BTreeMap<TypeName, Definition>,
    interfaces: BTreeMap<TypeName, Interface>,
}

impl Registry {
    /// Returns an empty registry.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds the types of one text. Call [`Registry::check`] after the last one.
    pub fn add(&mut self, interface: Interface) {
        for definition in expand(&interface) {
            self.types.insert(definition.name.clone(), definition);
        }
        self.interfaces.insert(interface.name.clone(), interface);
    }

    /// Adds the types of a schema as in bags and network protocols: the text of `name`, then for each type
    /// that it needs a line of `=`, a line `MSG: package/Name`, and its text. Existing types are replaced,
    /// because the schema describes the serialized data.
    ///
    /// Returns true if all of it was usable; otherwise the findings give the reasons.
    pub fn add_schema(
        &mut self,
        name: &TypeName,
        file: FileId,
        sources: &SourceMap,
        dialect: InterfaceDialect,
        diagnostics: &mut Diagnostics,
    ) -> bool {
        let whole = sources.whole(file);
        let text = sources.text(whole);
        let before = diagnostics.errors();
        let mut name = Some(name.clone());
        let (mut start, mut at) = (0, 0);
        let mut is_header = false;
        let mut pieces = Vec::new();
        for line in text.split_inclusive('\n') {
            let next = at + line.len();
            if is_separator(line) {
                pieces.extend(name.take().map(|name| (name, start, at)));
                is_header = true;
            } else if is_header {
                is_header = false;
                start = next;
                name = line.trim().strip_prefix("MSG:").map(str::trim).and_then(TypeName::read);
                if name.is_none() {
                    let wrong = "after a line of `=` a schema names the type that follows";
                    let wrong = Diagnostic::error("bad-schema", wrong).at(whole.part(at, next));
                    diagnostics.push(wrong.help("write `MSG: package/Name`"));
                }
            }
            at = next;
        }
        pieces.extend(name.take().map(|name| (name, start, text.len())));
        if dialect == InterfaceDialect::Ros1 {
            self.add_times();
        }
        for (name, start, end) in pieces {
            let span = whole.part(start, end);
            if let Some(interface) = parse::part(&name, span, sources, dialect, diagnostics) {
                self.add(interface);
            }
        }
        diagnostics.errors() == before
    }

    /// `time` and `duration`, which are built into ROS 1 and have no text there.
    fn add_times(&mut self) {
        let mut sources = SourceMap::new();
        for (name, text) in
            [("Time", "int32 sec\nuint32 nanosec\n"), ("Duration", "int32 sec\nuint32 nanosec\n")]
        {
            let name = TypeName::message("builtin_interfaces", name);
            if self.types.contains_key(&name) {
                continue;
            }
            let file = sources.add(name.to_string(), text);
            let read =
                parse(&name, file, &sources, InterfaceDialect::Ros2, &mut Diagnostics::new());
            read.into_iter().for_each(|interface| self.add(interface));
        }
    }

    /// Checks that every referenced type is known, none contains itself, and none is too large. Removes
    /// types that fail, and those that need them.
    pub fn check(&mut self, diagnostics: &mut Diagnostics) {
        let mut judged = BTreeMap::new();
        let names: Vec<TypeName> = self.types.keys().cloned().collect();
        for name in &names {
            self.judge(name, &mut Vec::new(), &mut judged, diagnostics);
        }
        let usable: BTreeSet<TypeName> = judged
            .iter()
            .filter(|(_, size)| size.is_some())
            .map(|(name, _)| (*name).clone())
            .collect();
        self.types.retain(|name, _| usable.contains(name));
        self.interfaces.retain(|_, interface| {
            interface.parts.iter().all(|part| self.types.contains_key(&part.name))
        });
    }

    /// Number of fixed elements of a type; `None` if it cannot be used.
    fn judge<'a>(
        &'a self,
        name: &'a TypeName,
        above: &mut Vec<&'a TypeName>,
        judged: &mut BTreeMap<&'a TypeName, Option<u64>>,
        diagnostics: &mut Diagnostics,
    ) -> Option<u64> {
        if let Some(known) = judged.get(name) {
            return *known;
        }
        let definition = self.types.get(name)?;
        above.push(name);
        let mut total = Some(0_u64);
        for field in &definition.fields {
            let one = match &field.r#type.element {
                crate::ElementType::Nested(nested) if above.contains(&nested) => {
                    let wrong = format!("`{name}` contains itself through `{nested}`");
                    diagnostics.push(Diagnostic::error("endless-type", wrong).at(field.origin));
                    None
                }
                crate::ElementType::Nested(nested) if !self.types.contains_key(nested) => {
                    diagnostics.push(self.unknown(definition, field, nested));
                    None
                }
                crate::ElementType::Nested(_) if above.len() >= MAX_DEPTH => {
                    let wrong = format!("types are nested deeper than {MAX_DEPTH} here");
                    diagnostics.push(Diagnostic::error("deep-type", wrong).at(field.origin));
                    None
                }
                crate::ElementType::Nested(nested) => {
                    self.judge(nested, above, judged, diagnostics)
                }
                _ => Some(1),
            };
            let times = if let ArrayShape::Fixed(size) = field.r#type.shape { size } else { 1 };
            let added = one.and_then(|one| one.checked_mul(times)).zip(total);
            total = added.and_then(|(one, total)| one.checked_add(total));
            if total.is_some_and(|total| total > MAX_FIXED_ELEMENTS) {
                let wrong =
                    format!("`{name}` has more than {MAX_FIXED_ELEMENTS} elements of fixed number");
                diagnostics.push(Diagnostic::error("large-type", wrong).at(field.origin));
                total = None;
            }
        }
        above.pop();
        judged.insert(name, total);
        total
    }

    fn unknown(&self, at: &Definition, field: &crate::Field, nested: &TypeName) -> Diagnostic {
        let wrong = format!("`{}` needs the unknown type `{nested}`", at.name);
        let short = nested.short();
        let same_package = self.types.keys().filter(|known| known.package == nested.package);
        let all = self.types.keys().filter(|known| known.name == nested.name);
        let known: Vec<String> = all.chain(same_package).map(TypeName::short).collect();
        let wrong = Diagnostic::error("unknown-type", wrong).at(field.origin);
        let same_name = known.iter().find(|one| one.ends_with(&format!("/{}", nested.name)));
        if let Some(same) = same_name {
            return wrong.help(format!("there is `{same}`"));
        }
        match periplus_diagnostics::closest(&short, known.iter().map(String::as_str)) {
            Some(near) => wrong.help(format!("did you mean `{near}`?")),
            None => wrong.help(format!("add the package `{}`", nested.package)),
        }
    }

    /// Definition of a type.
    #[must_use]
    pub fn get(&self, name: &TypeName) -> Option<&Definition> {
        self.types.get(name)
    }

    /// Interface of a text.
    #[must_use]
    pub fn interface(&self, name: &TypeName) -> Option<&Interface> {
        self.interfaces.get(name)
    }

    /// All types, by name.
    pub fn types(&self) -> impl Iterator<Item = &Definition> {
        self.types.values()
    }

    /// Interfaces of the texts, by name.
    pub fn interfaces(&self) -> impl Iterator<Item = &Interface> {
        self.interfaces.values()
    }

    /// All types that a type refers to, at any depth, by name, without itself.
    #[must_use]
    pub fn referenced(&self, name: &TypeName) -> BTreeSet<TypeName> {
        let mut found = BTreeSet::new();
        let mut ahead = vec![name];
        while let Some(definition) = ahead.pop().and_then(|name| self.types.get(name)) {
            for (_, nested) in definition.nested() {
                if found.insert(nested.clone()) {
                    ahead.push(nested);
                }
            }
        }
        found.remove(name);
        found
    }
}

fn is_separator(line: &str) -> bool {
    let line = line.trim_end();
    line == SEPARATOR || line.len() >= 40 && line.bytes().all(|b| b == b'=')
}
