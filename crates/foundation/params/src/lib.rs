//! Parameters declared once: name, type, unit, default, range, doc.
//!
//! A [`Table`] is a constant. It generates the reader of user input ([`Table::check`]), the file of
//! defaults ([`Table::to_yaml`]) and the manual ([`Table::to_markdown`]), so that they always agree.
//! [`params!`] declares a table together with a structure that has a typed field for each parameter:
//!
//! ```
//! use periplus_params::{Given, params};
//! use periplus_diagnostics::Diagnostics;
//!
//! params! {
//!     /// A light that blinks.
//!     #[table(BLINKER, "blinker")]
//!     pub struct BlinkerParams {
//!         /// Period of the flashes.
//!         #[param("period", unit("s"), above(0.0))]
//!         period_s: f64 = 2,
//!     }
//! }
//!
//! let mut diagnostics = Diagnostics::new();
//! let values = BLINKER.check([Given::new("period", "0.5")], None, &mut diagnostics);
//! assert_eq!(BlinkerParams::from_values(&values), BlinkerParams { period_s: 0.5 });
//! assert!(diagnostics.is_empty());
//! ```

mod check;
mod document;
mod error;
mod field;
mod macros;
mod parameter;
mod value;
mod values;

pub use check::Given;
pub use error::ParamError;
pub use field::{ParamChoice, ParamField, Params};
#[doc(hidden)]
pub use field::{checked, concat, count, declare};
pub use parameter::{
    Default, NamedEntity, ParamRange, ParamType, Parameter, Table, choice, flag, group, integer,
    number, numbers, text, texts,
};
pub use value::ParamValue;
pub use values::ParamValues;
