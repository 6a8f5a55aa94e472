//! Parameters declared once: name, type, unit, default, range, doc
