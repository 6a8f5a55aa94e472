//! Common implementation of all generated types.

/// Struct that is a [`crate::Message`].
#[doc(hidden)]
#[macro_export]
macro_rules! message {
    (
        $(#[$doc:meta])*
        $type_name:literal $type_hash:literal
        $name:ident {
            $($(#[$field_doc:meta])* $field:ident: $type:ty $(| $limit:literal)? $(= $default:expr)?,)*
        }
        $($(#[$const_doc:meta])* $const:ident: $const_type:ty = $value:expr;)*
    ) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name {
            $($(#[$field_doc])* pub $field: $type,)*
        }

        impl $name {
            $($(#[$const_doc])* pub const $const: $const_type = $value;)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self {
                    $($field: $crate::message!(@default $($default)?),)*
                }
            }
        }

        impl $crate::Codec for $name {
            const MIN_BYTES: usize = 0 $(+ <$type as $crate::Codec>::MIN_BYTES)*;

            fn blank() -> Self {
                Self::default()
            }

            fn write(&self, sink: &mut dyn $crate::Sink, _: Option<u32>) {
                sink.begin($type_name);
                $(
                    $crate::write_field(
                        &self.$field,
                        const { $crate::plain(stringify!($field)) },
                        $crate::message!(@limit $($limit)?),
                        sink,
                    );
                )*
                sink.end(Self::FIELDS.is_empty());
            }

            fn read(
                &mut self,
                source: &mut dyn $crate::Source,
                _: Option<u32>,
            ) -> Result<(), $crate::DecodeError> {
                source.begin($type_name, &mut Self::FIELDS.iter().copied())?;
                $(
                    $crate::read_field(
                        &mut self.$field,
                        const { $crate::plain(stringify!($field)) },
                        $crate::message!(@limit $($limit)?),
                        source,
                    )?;
                )*
                source.end(Self::FIELDS.is_empty())
            }
        }

        impl $name {
            const FIELDS: &[&str] = &[$($crate::plain(stringify!($field)),)*];
        }

        impl $crate::Message for $name {
            const TYPE_NAME: &'static str = $type_name;
            const TYPE_HASH: &'static str = $type_hash;
        }
    };
    (@default) => { $crate::Codec::blank() };
    (@default $default:expr) => { $default };
    (@limit) => { None };
    (@limit $limit:literal) => { Some($limit) };
}

/// A [`crate::Service`].
#[doc(hidden)]
#[macro_export]
macro_rules! service {
    (
        $(#[$doc:meta])*
        $type_name:literal $type_hash:literal
        $name:ident, $request:ident, $response:ident
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl $crate::Service for $name {
            type Request = $request;
            type Response = $response;
            const TYPE_NAME: &'static str = $type_name;
            const TYPE_HASH: &'static str = $type_hash;
        }
    };
}

/// A [`crate::Action`].
#[doc(hidden)]
#[macro_export]
macro_rules! action {
    (
        $(#[$doc:meta])*
        $type_name:literal $type_hash:literal
        $name:ident, $goal:ident, $result:ident, $feedback:ident,
        $send_goal:ident, $get_result:ident, $feedback_message:ident
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl $crate::Action for $name {
            type Goal = $goal;
            type Result = $result;
            type Feedback = $feedback;
            type SendGoal = $send_goal;
            type GetResult = $get_result;
            type FeedbackMessage = $feedback_message;
            const TYPE_NAME: &'static str = $type_name;
            const TYPE_HASH: &'static str = $type_hash;

            fn send_goal_request(
                goal_id: $crate::unique_identifier_msgs::UUID,
                goal: $goal,
            ) -> <$send_goal as $crate::Service>::Request {
                let mut request = <$send_goal as $crate::Service>::Request::default();
                request.goal_id = goal_id;
                request.goal = goal;
                request
            }

            fn goal_of_request(
                request: &<$send_goal as $crate::Service>::Request,
            ) -> (&$crate::unique_identifier_msgs::UUID, &$goal) {
                (&request.goal_id, &request.goal)
            }

            fn send_goal_response(
                accepted: bool,
                stamp: $crate::builtin_interfaces::Time,
            ) -> <$send_goal as $crate::Service>::Response {
                let mut response = <$send_goal as $crate::Service>::Response::default();
                response.accepted = accepted;
                response.stamp = stamp;
                response
            }

            fn acceptance_of_response(
                response: &<$send_goal as $crate::Service>::Response,
            ) -> (bool, &$crate::builtin_interfaces::Time) {
                (response.accepted, &response.stamp)
            }

            fn get_result_request(
                goal_id: $crate::unique_identifier_msgs::UUID,
            ) -> <$get_result as $crate::Service>::Request {
                let mut request = <$get_result as $crate::Service>::Request::default();
                request.goal_id = goal_id;
                request
            }

            fn goal_id_of_request(
                request: &<$get_result as $crate::Service>::Request,
            ) -> &$crate::unique_identifier_msgs::UUID {
                &request.goal_id
            }

            fn get_result_response(
                status: i8,
                result: $result,
            ) -> <$get_result as $crate::Service>::Response {
                let mut response = <$get_result as $crate::Service>::Response::default();
                response.status = status;
                response.result = result;
                response
            }

            fn result_of_response(
                response: &<$get_result as $crate::Service>::Response,
            ) -> (i8, &$result) {
                (response.status, &response.result)
            }

            fn feedback_message(
                goal_id: $crate::unique_identifier_msgs::UUID,
                feedback: $feedback,
            ) -> $feedback_message {
                $feedback_message { goal_id, feedback }
            }

            fn feedback_of_message(
                message: &$feedback_message,
            ) -> (&$crate::unique_identifier_msgs::UUID, &$feedback) {
                (&message.goal_id, &message.feedback)
            }
        }
    };
}

/// Interface texts of the types, with their paths below `interfaces`.
#[doc(hidden)]
#[macro_export]
macro_rules! sources {
    ($($path:literal)*) => {
        pub(crate) const SOURCES: &[(&str, &str)] = &[$((
            $path,
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/interfaces/", $path)),
        ),)*];
    };
}

/// Defines `every_message!`, which passes all types to another macro.
#[doc(hidden)]
#[macro_export]
macro_rules! list_messages {
    ($($package:ident::$name:ident)*) => {
        /// Passes all messages of this crate to a macro.
        #[macro_export]
        macro_rules! every_message {
            ($do:ident) => { $do! { $($package::$name)* } };
        }
    };
}

/// Defines `every_service!`, which passes all services to another macro.
#[doc(hidden)]
#[macro_export]
macro_rules! list_services {
    ($($package:ident::$name:ident)*) => {
        /// Passes all services of this crate to a macro.
        #[macro_export]
        macro_rules! every_service {
            ($do:ident) => { $do! { $($package::$name)* } };
        }
    };
}
