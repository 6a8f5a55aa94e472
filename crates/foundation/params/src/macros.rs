//! Macros that declare parameters with their Rust types.

/// Declares the parameters of a component as a structure with typed fields, and their [`Table`].
///
/// Each field declares a parameter once: its documentation, its name in ROS, its type (the Rust type of the
/// field), its default as a literal, and in `param` the methods of [`Parameter`] that add the rest: `unit`,
/// `min`, `above`, `within`, `also`, `naming`, `required`, `unless`. Generated are the structure, a
/// [`Default`](std::default::Default) with the defaults of the table, conversions from and to
/// [`ParamValues`], and the table itself, if the `table` attribute names it.
///
/// A field of type [`Option`] or of a list needs no default. A parameter that is accepted but has no effect
/// is declared with `_` in place of a field. `#[shared]` inserts the parameters of another such structure.
/// Errors in the declaration, such as a default of the wrong type, do not compile.
///
/// ```
/// use periplus_params::{Given, ParamValues, params};
/// use periplus_diagnostics::Diagnostics;
///
/// params! {
///     /// Costs that decrease with the distance from obstacles.
///     #[table(INFLATION, "an inflation layer")]
///     pub struct InflationParams {
///         /// Enables the layer.
///         #[param("enabled")]
///         enabled: bool = true,
///         /// Distance up to which costs are set; 0 for none.
///         #[param("inflation_radius", unit("m"), min(0.0))]
///         radius_m: f64 = 0.55,
///         /// Unused; a single thread is used.
///         #[param("num_threads")]
///         _: i64 = -1,
///     }
/// }
///
/// assert_eq!(InflationParams::default(), InflationParams { enabled: true, radius_m: 0.55 });
/// let mut diagnostics = Diagnostics::new();
/// let values = INFLATION.check([Given::new("inflation_radius", "0.3")], None, &mut diagnostics);
/// assert_eq!(InflationParams::from_values(&values).radius_m, 0.3);
/// ```
///
/// [`Table`]: crate::Table
/// [`Parameter`]: crate::Parameter
/// [`ParamValues`]: crate::ParamValues
#[macro_export]
macro_rules! params {
    (
        $(#[doc = $doc:literal])+
        $(#[table($table:ident, $table_name:literal)])?
        $vis:vis struct $name:ident { $($fields:tt)* }
    ) => {
        $(
            #[doc = concat!("Table of the parameters in [`", stringify!($name), "`].")]
            $vis static $table: $crate::Table = $crate::Table {
                name: $table_name,
                doc: <$name as $crate::Params>::DOC,
                parameters: <$name as $crate::Params>::PARAMETERS,
            };

            impl ::std::default::Default for $name {
                fn default() -> Self {
                    <Self as $crate::Params>::from_values(&$crate::ParamValues::defaults(&$table))
                }
            }

            impl $name {
                /// Converts values of the table.
                #[must_use]
                $vis fn from_values(values: &$crate::ParamValues) -> Self {
                    <Self as $crate::Params>::from_values(values)
                }

                /// Converts to values of the table.
                #[must_use]
                $vis fn to_values(&self) -> $crate::ParamValues {
                    let mut values = $crate::ParamValues::defaults(&$table);
                    $crate::Params::write_to(self, &mut values);
                    values
                }
            }
        )?
        $crate::__params_fields! {
            { [$($doc)+] $vis $name }
            {} {} {} {}
            $($fields)*
        }
    };
}

/// Reads the fields of [`params!`] one by one, and collects the declarations of the structure, the parts of
/// the table, the expressions that read the fields, and those that write them.
#[doc(hidden)]
#[macro_export]
macro_rules! __params_fields {
    // A parameter without effect.
    (
        $head:tt { $($structure:tt)* } { $($parts:tt)* } { $($reads:tt)* } { $($writes:tt)* }
        $(#[doc = $doc:literal])+
        #[param($param:literal $(, $key:ident($($argument:expr),*))*)]
        _: $type:ty $(= $default:literal)?,
        $($rest:tt)*
    ) => {
        $crate::__params_fields! {
            $head
            { $($structure)* }
            {
                $($parts)*
                $crate::__params_entry! {
                    $type, $param, [$($doc)+] [$($default)?] [$(.$key($($argument),*))*]
                },
            }
            { $($reads)* }
            { $($writes)* }
            $($rest)*
        }
    };
    // A parameter.
    (
        $head:tt { $($structure:tt)* } { $($parts:tt)* } { $($reads:tt)* } { $($writes:tt)* }
        $(#[doc = $doc:literal])+
        #[param($param:literal $(, $key:ident($($argument:expr),*))*)]
        $field:ident: $type:ty $(= $default:literal)?,
        $($rest:tt)*
    ) => {
        $crate::__params_fields! {
            $head
            {
                $($structure)*
                $(#[doc = $doc])+
                #[doc = concat!(
                    "\n\nParameter `", $param, "`" $(, " (default `", stringify!($default), "`)")?, "."
                )]
                pub $field: $type,
            }
            {
                $($parts)*
                $crate::__params_entry! {
                    $type, $param, [$($doc)+] [$($default)?] [$(.$key($($argument),*))*]
                },
            }
            { $($reads)* $field = |values| $crate::ParamField::from_param(values.get($param)); }
            {
                $($writes)*
                $field = |it, values| if let Some(value) = $crate::ParamField::to_param(it) {
                    values.set($param, value);
                };
            }
            $($rest)*
        }
    };
    // Parameters of another structure.
    (
        $head:tt { $($structure:tt)* } { $($parts:tt)* } { $($reads:tt)* } { $($writes:tt)* }
        $(#[doc = $doc:literal])+
        #[shared]
        $field:ident: $type:ty,
        $($rest:tt)*
    ) => {
        $crate::__params_fields! {
            $head
            { $($structure)* $(#[doc = $doc])+ pub $field: $type, }
            { $($parts)* <$type as $crate::Params>::PARAMETERS, }
            { $($reads)* $field = |values| <$type as $crate::Params>::from_values(values); }
            { $($writes)* $field = |it, values| $crate::Params::write_to(it, values); }
            $($rest)*
        }
    };
    // All fields are read.
    (
        { [$($doc:literal)+] $vis:vis $name:ident }
        { $($structure:tt)* }
        { $($parts:tt)* }
        { $($field:ident = |$values:ident| $read:expr;)* }
        { $($_field:ident = |$it:ident, $out:ident| $write:expr;)* }
    ) => {
        $(#[doc = $doc])+
        #[derive(Clone, Debug, PartialEq)]
        $vis struct $name { $($structure)* }

        impl $crate::Params for $name {
            const DOC: &'static str = concat!($($doc),+).trim_ascii();

            const PARAMETERS: &'static [$crate::Parameter] = {
                const PARTS: &[&[$crate::Parameter]] = &[$($parts)*];
                &$crate::concat::<{ $crate::count(PARTS) }>(PARTS)
            };

            fn from_values(values: &$crate::ParamValues) -> Self {
                Self { $($field: { let $values = values; $read }),* }
            }

            fn write_to(&self, values: &mut $crate::ParamValues) {
                $({ let ($it, $out) = (&self.$field, &mut *values); $write; })*
            }
        }
    };
}

/// Part of a table with one parameter: its type, name, documentation, default, and further methods of
/// [`Parameter`](crate::Parameter).
#[doc(hidden)]
#[macro_export]
macro_rules! __params_entry {
    (
        $type:ty, $param:literal, [$($doc:literal)+] [$($default:literal)?] [$($methods:tt)*]
    ) => {
        &[$crate::checked::<$type>(
            $crate::declare::<$type>(
                $param,
                concat!($($doc),+).trim_ascii(),
                &[$(stringify!($default))?],
            )
            $($methods)*
        )]
    };
}

/// Declares an enumeration whose variants are the words of a parameter.
///
/// The variant that is marked `#[default]` stands for a parameter that is not set. Further words after `|`
/// are alternative spellings of a variant.
///
/// ```
/// use periplus_params::{ParamChoice, param_choice};
///
/// param_choice! {
///     /// Sensor model.
///     pub enum SensorModel {
///         /// Distance to the nearest obstacle.
///         #[default]
///         LikelihoodField = "likelihood_field",
///         /// Ray casting.
///         Beam = "beam" | "ray_casting",
///     }
/// }
///
/// assert_eq!(SensorModel::of_word("ray_casting"), SensorModel::Beam);
/// assert_eq!(SensorModel::default().word(), "likelihood_field");
/// ```
#[macro_export]
macro_rules! param_choice {
    (
        $(#[$attribute:meta])*
        $vis:vis enum $name:ident {
            $($(#[$variant_attribute:meta])* $variant:ident = $word:literal $(| $also:literal)*),+ $(,)?
        }
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        $vis enum $name {
            $($(#[$variant_attribute])* $variant),+
        }

        impl $crate::ParamChoice for $name {
            const WORDS: &'static [&'static str] = &[$($word $(, $also)*),+];

            fn of_word(word: &str) -> Self {
                match word {
                    $($word $(| $also)* => Self::$variant,)+
                    _ => Self::default(),
                }
            }

            fn word(self) -> &'static str {
                match self {
                    $(Self::$variant => $word),+
                }
            }
        }
    };
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::Diagnostics;

    use crate::{Given, NamedEntity, ParamValue, Parameter, Table, choice, flag, integer, number};
    use crate::{numbers, text, texts};

    param_choice! {
        /// Side of the vehicle.
        enum Side {
            /// Left.
            #[default]
            Left = "left",
            /// Right.
            Right = "right" | "starboard",
        }
    }

    params! {
        /// Parameters of every wheel.
        struct CommonParams {
            /// Enables the wheel.
            #[param("enabled")]
            is_enabled: bool = true,
        }
    }

    params! {
        /// A wheel
        /// with a motor.
        #[table(WHEEL, "wheel")]
        struct WheelParams {
            /// Parameters of every wheel.
            #[shared]
            common: CommonParams,
            /// Radius.
            #[param("radius", unit("m"), above(0.0), also(&["r"]))]
            radius_m: f64 = 0.15,
            /// Offset.
            #[param("offset", unit("m"))]
            offset_m: f64 = -1,
            /// Teeth of the gear.
            #[param("teeth", within(1.0, 100.0))]
            teeth: usize = 20,
            /// Joint.
            #[param("joint", required(), naming(NamedEntity::Joint))]
            joint: String,
            /// Side.
            #[param("side")]
            side: Side = "left",
            /// Torque limit.
            #[param("max_torque", unit("N m"))]
            max_torque_n_m: Option<f64>,
            /// Gains.
            #[param("gains")]
            gains: Vec<f64> = "1 0 0",
            /// Topics.
            #[param("topics")]
            topics: Vec<String>,
            /// Has no effect.
            #[param("unused")]
            _: String = "",
        }
    }

    #[test]
    fn the_table_is_that_of_the_builders() {
        const BUILT: &[Parameter] = &[
            flag("enabled", "Enables the wheel.").or("true"),
            number("radius", "m", "Radius.").or("0.15").above(0.0).also(&["r"]),
            number("offset", "m", "Offset.").or("-1"),
            integer("teeth", "Teeth of the gear.").or("20").within(1.0, 100.0),
            text("joint", "Joint.").required().naming(NamedEntity::Joint),
            choice("side", &["left", "right", "starboard"], "Side.").or("left"),
            number("max_torque", "N m", "Torque limit."),
            numbers("gains", "", "Gains.").or("1 0 0"),
            texts("topics", "Topics."),
            text("unused", "Has no effect.").or(""),
        ];
        static BY_HAND: Table =
            Table { name: "wheel", doc: "A wheel with a motor.", parameters: BUILT };
        assert_eq!(WHEEL, BY_HAND);
        assert_eq!(WHEEL.faults(), [""; 0]);
    }

    #[test]
    fn defaults_are_those_of_the_table() {
        let expected = WheelParams {
            common: CommonParams { is_enabled: true },
            radius_m: 0.15,
            offset_m: -1.0,
            teeth: 20,
            joint: String::new(),
            side: Side::Left,
            max_torque_n_m: None,
            gains: vec![1.0, 0.0, 0.0],
            topics: Vec::new(),
        };
        assert_eq!(WheelParams::default(), expected);
    }

    #[test]
    fn fields_come_back_from_values() {
        let mut diagnostics = Diagnostics::new();
        let given = [
            ("r", "0.3"),
            ("enabled", "false"),
            ("joint", "left_wheel"),
            ("side", "Starboard"),
            ("max_torque", "2"),
            ("topics", "a b"),
        ];
        let given = given.map(|(name, text)| Given::new(name, text));
        let wheel = WheelParams::from_values(&WHEEL.check(given, None, &mut diagnostics));
        assert!(diagnostics.is_empty(), "{diagnostics:?}");
        let expected = WheelParams {
            common: CommonParams { is_enabled: false },
            radius_m: 0.3,
            joint: "left_wheel".into(),
            side: Side::Right,
            max_torque_n_m: Some(2.0),
            topics: vec!["a".into(), "b".into()],
            ..WheelParams::default()
        };
        assert_eq!(wheel, expected);
        let values = wheel.to_values();
        assert_eq!(values.get("side"), Some(ParamValue::Text("right".into())));
        assert_eq!(WheelParams::from_values(&values), wheel);
    }
}
