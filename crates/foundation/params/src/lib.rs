//! Parameters declared once: name, type, unit, default, range, doc.
//!
//! A [`Table`] is a constant. It generates the reader of user input ([`Table::check`]), the file of
//! defaults ([`Table::to_yaml`]) and the manual ([`Table::to_markdown`]), so that they always agree.
//! Defaults are written as a user would write them and read by the same code.
//!
//! ```
//! use periplus_params::{Given, Table, flag, number};
//! use periplus_diagnostics::Diagnostics;
//!
//! static LAMP: Table = Table {
//!     name: "lamp",
//!     doc: "A lamp that blinks.",
//!     parameters: &[
//!         number("period", "s", "Time from flash to flash.").or("2").above(0.0),
//!         flag("lit", "Whether it starts lit.").or("false"),
//!     ],
//! };
//!
//! let mut diagnostics = Diagnostics::new();
//! let values = LAMP.check([Given::new("period", "0.5")], None, &mut diagnostics);
//! assert_eq!(values.number("period"), Some(0.5));
//! assert_eq!(values.flag("lit"), Some(false));
//! assert!(diagnostics.is_empty());
//! ```

mod check;
mod document;
mod error;
mod parameter;
mod value;
mod values;

pub use check::Given;
pub use error::ParamError;
pub use parameter::{
    Default, NamedEntity, ParamRange, ParamType, Parameter, Table, choice, flag, group, integer,
    number, numbers, text, texts,
};
pub use value::ParamValue;
pub use values::ParamValues;
