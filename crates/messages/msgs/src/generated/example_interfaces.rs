//! `example_interfaces`. Made by `cargo xtask codegen`; edit the texts in `interfaces/example_interfaces`
//! instead.

crate::message! {
    /// Numbers, each the sum of the two before it.
    "example_interfaces/action/Fibonacci_Goal" "RIHS01_226cb437e4355dcd3e914f930382a3b0cc1da81545bd319ed554e95a03255f51"
    FibonacciGoal {
        /// How many.
        order: i32,
    }
}

crate::message! {
    /// `example_interfaces/action/Fibonacci_Result`.
    "example_interfaces/action/Fibonacci_Result" "RIHS01_fea81394f25aa4502217953f1a021fb750e79c10bbd43f13dd94632da6569649"
    FibonacciResult {
        /// All of them.
        sequence: Vec<i32>,
    }
}

crate::message! {
    /// `example_interfaces/action/Fibonacci_Feedback`.
    "example_interfaces/action/Fibonacci_Feedback" "RIHS01_2b12e37361da6f408d4c85bc24a18de64333f29082f2ca34b5ee33dc4c8b42a9"
    FibonacciFeedback {
        /// Those so far.
        sequence: Vec<i32>,
    }
}

crate::message! {
    /// `example_interfaces/action/Fibonacci_SendGoal_Request`.
    "example_interfaces/action/Fibonacci_SendGoal_Request" "RIHS01_3d088942b413247db536576f0286768c6be8fcd5d0c9a5d544f359fba090a238"
    FibonacciSendGoalRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// goal
        goal: FibonacciGoal,
    }
}

crate::message! {
    /// `example_interfaces/action/Fibonacci_SendGoal_Response`.
    "example_interfaces/action/Fibonacci_SendGoal_Response" "RIHS01_d8c07bb3d5b766fe4b43159c9a5222af5214e2fcc29229b991d826166c512be1"
    FibonacciSendGoalResponse {
        /// accepted
        accepted: bool,
        /// stamp
        stamp: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// `example_interfaces/action/Fibonacci_GetResult_Request`.
    "example_interfaces/action/Fibonacci_GetResult_Request" "RIHS01_c8a4f5e7d13b81286ee1043e2ecd084281cecf1ff06aaa799464f5f15479f003"
    FibonacciGetResultRequest {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
    }
}

crate::message! {
    /// `example_interfaces/action/Fibonacci_GetResult_Response`.
    "example_interfaces/action/Fibonacci_GetResult_Response" "RIHS01_6021dc98ab9b4bbe395e48aa4de81ee5f68eb570f88358affcc648146668b24f"
    FibonacciGetResultResponse {
        /// status
        status: i8,
        /// result
        result: FibonacciResult,
    }
}

crate::message! {
    /// `example_interfaces/action/Fibonacci_FeedbackMessage`.
    "example_interfaces/action/Fibonacci_FeedbackMessage" "RIHS01_c1de71afd52e49a89c53d8262366884185bc0a02f78ce051c4e46b0a7fe59bb2"
    FibonacciFeedbackMessage {
        /// goal_id
        goal_id: crate::unique_identifier_msgs::UUID,
        /// feedback
        feedback: FibonacciFeedback,
    }
}

crate::service! {
    /// `example_interfaces/action/Fibonacci_SendGoal`.
    "example_interfaces/action/Fibonacci_SendGoal" "RIHS01_d1a57fb2a4afe8c21e34fb10db206f16ce6729b28531141472df92277c55b557"
    FibonacciSendGoal, FibonacciSendGoalRequest, FibonacciSendGoalResponse
}

crate::service! {
    /// `example_interfaces/action/Fibonacci_GetResult`.
    "example_interfaces/action/Fibonacci_GetResult" "RIHS01_1b0de0d5d29dc955d92f546706568428632771db13ec84c15ec1c1a59f424a57"
    FibonacciGetResult, FibonacciGetResultRequest, FibonacciGetResultResponse
}

crate::action! {
    /// Numbers, each the sum of the two before it.
    "example_interfaces/action/Fibonacci" "RIHS01_9508051da1ea4658de144b09bd0690ff3de52104683d847aed764d2915906f51"
    Fibonacci, FibonacciGoal, FibonacciResult, FibonacciFeedback,
    FibonacciSendGoal, FibonacciGetResult, FibonacciFeedbackMessage
}
