//! `type_description_interfaces`. Made by `cargo xtask codegen`; edit the texts in `interfaces/type_description_interfaces`
//! instead.

crate::message! {
    /// A field of a type.
    "type_description_interfaces/msg/Field" "RIHS01_c0b01379cd4226281285ccaf6be46653968f855f7c5e41614ff5d7a854efef7c"
    Field {
        /// name
        name: std::string::String,
        /// type
        r#type: FieldType,
        /// default_value
        default_value: std::string::String,
    }
}

crate::message! {
    /// The type of a field.
    "type_description_interfaces/msg/FieldType" "RIHS01_a70b6dd919645a03a3586f7f821defbc886ea3e531a1d95cc0f380a3973ccaa6"
    FieldType {
        /// type_id
        type_id: u8 = 0,
        /// capacity
        capacity: u64,
        /// string_capacity
        string_capacity: u64,
        /// nested_type_name
        nested_type_name: std::string::String | 255,
    }
    /// FIELD_TYPE_NOT_SET
    FIELD_TYPE_NOT_SET: u8 = 0;
    /// FIELD_TYPE_NESTED_TYPE
    FIELD_TYPE_NESTED_TYPE: u8 = 1;
    /// FIELD_TYPE_INT8
    FIELD_TYPE_INT8: u8 = 2;
    /// FIELD_TYPE_UINT8
    FIELD_TYPE_UINT8: u8 = 3;
    /// FIELD_TYPE_INT16
    FIELD_TYPE_INT16: u8 = 4;
    /// FIELD_TYPE_UINT16
    FIELD_TYPE_UINT16: u8 = 5;
    /// FIELD_TYPE_INT32
    FIELD_TYPE_INT32: u8 = 6;
    /// FIELD_TYPE_UINT32
    FIELD_TYPE_UINT32: u8 = 7;
    /// FIELD_TYPE_INT64
    FIELD_TYPE_INT64: u8 = 8;
    /// FIELD_TYPE_UINT64
    FIELD_TYPE_UINT64: u8 = 9;
    /// FIELD_TYPE_FLOAT
    FIELD_TYPE_FLOAT: u8 = 10;
    /// FIELD_TYPE_DOUBLE
    FIELD_TYPE_DOUBLE: u8 = 11;
    /// FIELD_TYPE_LONG_DOUBLE
    FIELD_TYPE_LONG_DOUBLE: u8 = 12;
    /// FIELD_TYPE_CHAR
    FIELD_TYPE_CHAR: u8 = 13;
    /// FIELD_TYPE_WCHAR
    FIELD_TYPE_WCHAR: u8 = 14;
    /// FIELD_TYPE_BOOLEAN
    FIELD_TYPE_BOOLEAN: u8 = 15;
    /// FIELD_TYPE_BYTE
    FIELD_TYPE_BYTE: u8 = 16;
    /// FIELD_TYPE_STRING
    FIELD_TYPE_STRING: u8 = 17;
    /// FIELD_TYPE_WSTRING
    FIELD_TYPE_WSTRING: u8 = 18;
    /// FIELD_TYPE_FIXED_STRING
    FIELD_TYPE_FIXED_STRING: u8 = 19;
    /// FIELD_TYPE_FIXED_WSTRING
    FIELD_TYPE_FIXED_WSTRING: u8 = 20;
    /// FIELD_TYPE_BOUNDED_STRING
    FIELD_TYPE_BOUNDED_STRING: u8 = 21;
    /// FIELD_TYPE_BOUNDED_WSTRING
    FIELD_TYPE_BOUNDED_WSTRING: u8 = 22;
    /// FIELD_TYPE_NESTED_TYPE_ARRAY
    FIELD_TYPE_NESTED_TYPE_ARRAY: u8 = 49;
    /// FIELD_TYPE_INT8_ARRAY
    FIELD_TYPE_INT8_ARRAY: u8 = 50;
    /// FIELD_TYPE_UINT8_ARRAY
    FIELD_TYPE_UINT8_ARRAY: u8 = 51;
    /// FIELD_TYPE_INT16_ARRAY
    FIELD_TYPE_INT16_ARRAY: u8 = 52;
    /// FIELD_TYPE_UINT16_ARRAY
    FIELD_TYPE_UINT16_ARRAY: u8 = 53;
    /// FIELD_TYPE_INT32_ARRAY
    FIELD_TYPE_INT32_ARRAY: u8 = 54;
    /// FIELD_TYPE_UINT32_ARRAY
    FIELD_TYPE_UINT32_ARRAY: u8 = 55;
    /// FIELD_TYPE_INT64_ARRAY
    FIELD_TYPE_INT64_ARRAY: u8 = 56;
    /// FIELD_TYPE_UINT64_ARRAY
    FIELD_TYPE_UINT64_ARRAY: u8 = 57;
    /// FIELD_TYPE_FLOAT_ARRAY
    FIELD_TYPE_FLOAT_ARRAY: u8 = 58;
    /// FIELD_TYPE_DOUBLE_ARRAY
    FIELD_TYPE_DOUBLE_ARRAY: u8 = 59;
    /// FIELD_TYPE_LONG_DOUBLE_ARRAY
    FIELD_TYPE_LONG_DOUBLE_ARRAY: u8 = 60;
    /// FIELD_TYPE_CHAR_ARRAY
    FIELD_TYPE_CHAR_ARRAY: u8 = 61;
    /// FIELD_TYPE_WCHAR_ARRAY
    FIELD_TYPE_WCHAR_ARRAY: u8 = 62;
    /// FIELD_TYPE_BOOLEAN_ARRAY
    FIELD_TYPE_BOOLEAN_ARRAY: u8 = 63;
    /// FIELD_TYPE_BYTE_ARRAY
    FIELD_TYPE_BYTE_ARRAY: u8 = 64;
    /// FIELD_TYPE_STRING_ARRAY
    FIELD_TYPE_STRING_ARRAY: u8 = 65;
    /// FIELD_TYPE_WSTRING_ARRAY
    FIELD_TYPE_WSTRING_ARRAY: u8 = 66;
    /// FIELD_TYPE_FIXED_STRING_ARRAY
    FIELD_TYPE_FIXED_STRING_ARRAY: u8 = 67;
    /// FIELD_TYPE_FIXED_WSTRING_ARRAY
    FIELD_TYPE_FIXED_WSTRING_ARRAY: u8 = 68;
    /// FIELD_TYPE_BOUNDED_STRING_ARRAY
    FIELD_TYPE_BOUNDED_STRING_ARRAY: u8 = 69;
    /// FIELD_TYPE_BOUNDED_WSTRING_ARRAY
    FIELD_TYPE_BOUNDED_WSTRING_ARRAY: u8 = 70;
    /// FIELD_TYPE_NESTED_TYPE_BOUNDED_SEQUENCE
    FIELD_TYPE_NESTED_TYPE_BOUNDED_SEQUENCE: u8 = 97;
    /// FIELD_TYPE_INT8_BOUNDED_SEQUENCE
    FIELD_TYPE_INT8_BOUNDED_SEQUENCE: u8 = 98;
    /// FIELD_TYPE_UINT8_BOUNDED_SEQUENCE
    FIELD_TYPE_UINT8_BOUNDED_SEQUENCE: u8 = 99;
    /// FIELD_TYPE_INT16_BOUNDED_SEQUENCE
    FIELD_TYPE_INT16_BOUNDED_SEQUENCE: u8 = 100;
    /// FIELD_TYPE_UINT16_BOUNDED_SEQUENCE
    FIELD_TYPE_UINT16_BOUNDED_SEQUENCE: u8 = 101;
    /// FIELD_TYPE_INT32_BOUNDED_SEQUENCE
    FIELD_TYPE_INT32_BOUNDED_SEQUENCE: u8 = 102;
    /// FIELD_TYPE_UINT32_BOUNDED_SEQUENCE
    FIELD_TYPE_UINT32_BOUNDED_SEQUENCE: u8 = 103;
    /// FIELD_TYPE_INT64_BOUNDED_SEQUENCE
    FIELD_TYPE_INT64_BOUNDED_SEQUENCE: u8 = 104;
    /// FIELD_TYPE_UINT64_BOUNDED_SEQUENCE
    FIELD_TYPE_UINT64_BOUNDED_SEQUENCE: u8 = 105;
    /// FIELD_TYPE_FLOAT_BOUNDED_SEQUENCE
    FIELD_TYPE_FLOAT_BOUNDED_SEQUENCE: u8 = 106;
    /// FIELD_TYPE_DOUBLE_BOUNDED_SEQUENCE
    FIELD_TYPE_DOUBLE_BOUNDED_SEQUENCE: u8 = 107;
    /// FIELD_TYPE_LONG_DOUBLE_BOUNDED_SEQUENCE
    FIELD_TYPE_LONG_DOUBLE_BOUNDED_SEQUENCE: u8 = 108;
    /// FIELD_TYPE_CHAR_BOUNDED_SEQUENCE
    FIELD_TYPE_CHAR_BOUNDED_SEQUENCE: u8 = 109;
    /// FIELD_TYPE_WCHAR_BOUNDED_SEQUENCE
    FIELD_TYPE_WCHAR_BOUNDED_SEQUENCE: u8 = 110;
    /// FIELD_TYPE_BOOLEAN_BOUNDED_SEQUENCE
    FIELD_TYPE_BOOLEAN_BOUNDED_SEQUENCE: u8 = 111;
    /// FIELD_TYPE_BYTE_BOUNDED_SEQUENCE
    FIELD_TYPE_BYTE_BOUNDED_SEQUENCE: u8 = 112;
    /// FIELD_TYPE_STRING_BOUNDED_SEQUENCE
    FIELD_TYPE_STRING_BOUNDED_SEQUENCE: u8 = 113;
    /// FIELD_TYPE_WSTRING_BOUNDED_SEQUENCE
    FIELD_TYPE_WSTRING_BOUNDED_SEQUENCE: u8 = 114;
    /// FIELD_TYPE_FIXED_STRING_BOUNDED_SEQUENCE
    FIELD_TYPE_FIXED_STRING_BOUNDED_SEQUENCE: u8 = 115;
    /// FIELD_TYPE_FIXED_WSTRING_BOUNDED_SEQUENCE
    FIELD_TYPE_FIXED_WSTRING_BOUNDED_SEQUENCE: u8 = 116;
    /// FIELD_TYPE_BOUNDED_STRING_BOUNDED_SEQUENCE
    FIELD_TYPE_BOUNDED_STRING_BOUNDED_SEQUENCE: u8 = 117;
    /// FIELD_TYPE_BOUNDED_WSTRING_BOUNDED_SEQUENCE
    FIELD_TYPE_BOUNDED_WSTRING_BOUNDED_SEQUENCE: u8 = 118;
    /// FIELD_TYPE_NESTED_TYPE_UNBOUNDED_SEQUENCE
    FIELD_TYPE_NESTED_TYPE_UNBOUNDED_SEQUENCE: u8 = 145;
    /// FIELD_TYPE_INT8_UNBOUNDED_SEQUENCE
    FIELD_TYPE_INT8_UNBOUNDED_SEQUENCE: u8 = 146;
    /// FIELD_TYPE_UINT8_UNBOUNDED_SEQUENCE
    FIELD_TYPE_UINT8_UNBOUNDED_SEQUENCE: u8 = 147;
    /// FIELD_TYPE_INT16_UNBOUNDED_SEQUENCE
    FIELD_TYPE_INT16_UNBOUNDED_SEQUENCE: u8 = 148;
    /// FIELD_TYPE_UINT16_UNBOUNDED_SEQUENCE
    FIELD_TYPE_UINT16_UNBOUNDED_SEQUENCE: u8 = 149;
    /// FIELD_TYPE_INT32_UNBOUNDED_SEQUENCE
    FIELD_TYPE_INT32_UNBOUNDED_SEQUENCE: u8 = 150;
    /// FIELD_TYPE_UINT32_UNBOUNDED_SEQUENCE
    FIELD_TYPE_UINT32_UNBOUNDED_SEQUENCE: u8 = 151;
    /// FIELD_TYPE_INT64_UNBOUNDED_SEQUENCE
    FIELD_TYPE_INT64_UNBOUNDED_SEQUENCE: u8 = 152;
    /// FIELD_TYPE_UINT64_UNBOUNDED_SEQUENCE
    FIELD_TYPE_UINT64_UNBOUNDED_SEQUENCE: u8 = 153;
    /// FIELD_TYPE_FLOAT_UNBOUNDED_SEQUENCE
    FIELD_TYPE_FLOAT_UNBOUNDED_SEQUENCE: u8 = 154;
    /// FIELD_TYPE_DOUBLE_UNBOUNDED_SEQUENCE
    FIELD_TYPE_DOUBLE_UNBOUNDED_SEQUENCE: u8 = 155;
    /// FIELD_TYPE_LONG_DOUBLE_UNBOUNDED_SEQUENCE
    FIELD_TYPE_LONG_DOUBLE_UNBOUNDED_SEQUENCE: u8 = 156;
    /// FIELD_TYPE_CHAR_UNBOUNDED_SEQUENCE
    FIELD_TYPE_CHAR_UNBOUNDED_SEQUENCE: u8 = 157;
    /// FIELD_TYPE_WCHAR_UNBOUNDED_SEQUENCE
    FIELD_TYPE_WCHAR_UNBOUNDED_SEQUENCE: u8 = 158;
    /// FIELD_TYPE_BOOLEAN_UNBOUNDED_SEQUENCE
    FIELD_TYPE_BOOLEAN_UNBOUNDED_SEQUENCE: u8 = 159;
    /// FIELD_TYPE_BYTE_UNBOUNDED_SEQUENCE
    FIELD_TYPE_BYTE_UNBOUNDED_SEQUENCE: u8 = 160;
    /// FIELD_TYPE_STRING_UNBOUNDED_SEQUENCE
    FIELD_TYPE_STRING_UNBOUNDED_SEQUENCE: u8 = 161;
    /// FIELD_TYPE_WSTRING_UNBOUNDED_SEQUENCE
    FIELD_TYPE_WSTRING_UNBOUNDED_SEQUENCE: u8 = 162;
    /// FIELD_TYPE_FIXED_STRING_UNBOUNDED_SEQUENCE
    FIELD_TYPE_FIXED_STRING_UNBOUNDED_SEQUENCE: u8 = 163;
    /// FIELD_TYPE_FIXED_WSTRING_UNBOUNDED_SEQUENCE
    FIELD_TYPE_FIXED_WSTRING_UNBOUNDED_SEQUENCE: u8 = 164;
    /// FIELD_TYPE_BOUNDED_STRING_UNBOUNDED_SEQUENCE
    FIELD_TYPE_BOUNDED_STRING_UNBOUNDED_SEQUENCE: u8 = 165;
    /// FIELD_TYPE_BOUNDED_WSTRING_UNBOUNDED_SEQUENCE
    FIELD_TYPE_BOUNDED_WSTRING_UNBOUNDED_SEQUENCE: u8 = 166;
}

crate::message! {
    /// A type without those that it needs.
    "type_description_interfaces/msg/IndividualTypeDescription" "RIHS01_55c827d86c3c141bdd318fe6c22e11190e4d3b37c8f4f9751a084aa05ce96560"
    IndividualTypeDescription {
        /// type_name
        type_name: std::string::String | 255,
        /// fields
        fields: Vec<Field>,
    }
}

crate::message! {
    /// A named text.
    "type_description_interfaces/msg/KeyValue" "RIHS01_274fe56bf14f33c7512e34c646a37579ee36779f745f049a9760763e817f0c42"
    KeyValue {
        /// key
        key: std::string::String,
        /// value
        value: std::string::String,
    }
}

crate::message! {
    /// A type with those that it needs.
    "type_description_interfaces/msg/TypeDescription" "RIHS01_739f2508c9fa3a6f330913ff5b9d25fb74159a077da71e1087f51a60c12a080b"
    TypeDescription {
        /// type_description
        type_description: IndividualTypeDescription,
        /// referenced_type_descriptions
        referenced_type_descriptions: Vec<IndividualTypeDescription>,
    }
}

crate::message! {
    /// The text that defines a type.
    "type_description_interfaces/msg/TypeSource" "RIHS01_faeaec7596c04ecf5b6e99ad225e4c7cbb997ad5435f793526fb3984d011aae5"
    TypeSource {
        /// type_name
        type_name: std::string::String,
        /// encoding
        encoding: std::string::String,
        /// raw_file_contents
        raw_file_contents: std::string::String,
    }
}

crate::message! {
    /// Asks what a type of a node is.
    "type_description_interfaces/srv/GetTypeDescription_Request" "RIHS01_470f56ccbcf13d55c78c8b735fb12da03e639e5acded994426c89d94778d9e28"
    GetTypeDescriptionRequest {
        /// type_name
        type_name: std::string::String,
        /// type_hash
        type_hash: std::string::String,
        /// include_type_sources
        include_type_sources: bool = true,
    }
}

crate::message! {
    /// `type_description_interfaces/srv/GetTypeDescription_Response`.
    "type_description_interfaces/srv/GetTypeDescription_Response" "RIHS01_648c49d976240861a482f961c5621ddd0d2135d8cce6f297a76d4f6376d93b75"
    GetTypeDescriptionResponse {
        /// successful
        successful: bool,
        /// failure_reason
        failure_reason: std::string::String,
        /// type_description
        type_description: TypeDescription,
        /// type_sources
        type_sources: Vec<TypeSource>,
        /// extra_information
        extra_information: Vec<KeyValue>,
    }
}

crate::service! {
    /// Asks what a type of a node is.
    "type_description_interfaces/srv/GetTypeDescription" "RIHS01_69b9c19c1021405984cc60dbbb1edceb147a6538b411d812ba6afabeed962cd5"
    GetTypeDescription, GetTypeDescriptionRequest, GetTypeDescriptionResponse
}
