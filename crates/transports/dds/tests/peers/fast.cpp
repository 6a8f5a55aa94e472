// A program that knows nothing of Periplus: Fast DDS, with messages written and read by Fast CDR.
// It says on its output what it saw, a line each; the tests compare the lines. See `peers.rs`.
//
//   fast DOMAIN pub  KIND TOPIC COUNT PERIOD_MS [latched]
//   fast DOMAIN hasty KIND TOPIC COUNT     one message on each of so many topics, TOPIC0 and on, the
//                                          moment that somebody is there to hear it
//   fast DOMAIN sub  KIND TOPIC COUNT [latched]
//   fast DOMAIN serve SERVICE COUNT        std_srvs/srv/Trigger
//   fast DOMAIN call  SERVICE COUNT
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <fastcdr/Cdr.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

using namespace eprosima::fastdds::dds;
using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;
using eprosima::fastrtps::rtps::SerializedPayload_t;

// All kinds in one: what a kind does not have stays empty.
struct Message {
    int32_t sec = 0;
    uint32_t nanosec = 0;
    std::string frame, child;
    uint32_t width = 0, height = 0, step = 0;
    std::vector<float> floats;
    std::vector<uint8_t> bytes;
    double x = 0;
    bool success = false;
};

struct Field {
    std::string name;
    uint32_t offset;
    uint8_t type;
};

static const Field FIELDS[] = {{"x", 0, 7}, {"y", 4, 7}, {"z", 8, 7}};

// Each kind is written once and read with the same list of fields.
template <typename Do>
static void walk(const std::string& kind, Message& m, Do& f) {
    if (kind == "request") {
        uint8_t none = 0;
        f(none);
        return;
    }
    if (kind == "response") {
        f(m.success);
        f(m.frame);
        return;
    }
    if (kind == "tf") {
        uint32_t count = 1;
        f(count);
    }
    f(m.sec);
    f(m.nanosec);
    f(m.frame);
    float zero = 0, one = 1;
    double nothing = 0, whole = 1;
    uint8_t no = 0;
    if (kind == "scan") {
        for (float* value : {&zero, &one, &one, &zero, &one, &zero, &one}) {
            f(*value);
        }
        f(m.floats);
        std::vector<float> intensities;
        f(intensities);
    } else if (kind == "cloud") {
        f(m.height);
        f(m.width);
        uint32_t count = 3, each = 1;
        f(count);
        for (const Field& field : FIELDS) {
            Field copy = field;
            f(copy.name);
            f(copy.offset);
            f(copy.type);
            f(each);
        }
        f(no);
        f(m.step);
        uint32_t row = m.step * m.width;
        f(row);
        f(m.bytes);
        uint8_t dense = 1;
        f(dense);
    } else if (kind == "image") {
        f(m.height);
        f(m.width);
        std::string encoding = "rgb8";
        f(encoding);
        f(no);
        f(m.step);
        f(m.bytes);
    } else if (kind == "grid") {
        int32_t load_sec = 0;
        uint32_t load_nanosec = 0;
        f(load_sec);
        f(load_nanosec);
        f(one);
        f(m.width);
        f(m.height);
        for (double* value : {&nothing, &nothing, &nothing, &nothing, &nothing, &nothing, &whole}) {
            f(*value);
        }
        f(m.bytes);
    } else if (kind == "tf") {
        f(m.child);
        f(m.x);
        for (double* value : {&nothing, &nothing, &nothing, &nothing, &nothing, &whole}) {
            f(*value);
        }
    }
}

struct Write {
    Cdr& cdr;
    template <typename T>
    void operator()(T& value) {
        cdr << value;
    }
};

struct Read {
    Cdr& cdr;
    template <typename T>
    void operator()(T& value) {
        cdr >> value;
    }
};

static std::string type_of(const std::string& kind) {
    if (kind == "scan") return "sensor_msgs::msg::dds_::LaserScan_";
    if (kind == "cloud") return "sensor_msgs::msg::dds_::PointCloud2_";
    if (kind == "image") return "sensor_msgs::msg::dds_::Image_";
    if (kind == "grid") return "nav_msgs::msg::dds_::OccupancyGrid_";
    if (kind == "tf") return "tf2_msgs::msg::dds_::TFMessage_";
    if (kind == "request") return "std_srvs::srv::dds_::Trigger_Request_";
    return "std_srvs::srv::dds_::Trigger_Response_";
}

class Type : public TopicDataType {
public:
    explicit Type(const std::string& of) : kind(of) {
        setName(type_of(kind).c_str());
        m_typeSize = 1024;
        m_isGetKeyDefined = false;
        auto_fill_type_object(false);
        auto_fill_type_information(false);
    }
    bool serialize(void* data, SerializedPayload_t* payload) override {
        FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->max_size);
        Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
        payload->encapsulation = cdr.endianness() == Cdr::BIG_ENDIANNESS ? CDR_BE : CDR_LE;
        cdr.serialize_encapsulation();
        Write write{cdr};
        walk(kind, *static_cast<Message*>(data), write);
        payload->length = static_cast<uint32_t>(cdr.getSerializedDataLength());
        return true;
    }
    bool deserialize(SerializedPayload_t* payload, void* data) override {
        try {
            FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
            Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
            cdr.read_encapsulation();
            Read read{cdr};
            walk(kind, *static_cast<Message*>(data), read);
            return true;
        } catch (const std::exception& error) {
            std::cout << "cannot read: " << error.what() << std::endl;
            return false;
        }
    }
    std::function<uint32_t()> getSerializedSizeProvider(void* data) override {
        const Message* m = static_cast<Message*>(data);
        const size_t size = 1024 + m->bytes.size() + 4 * m->floats.size();
        return [size] { return static_cast<uint32_t>(size); };
    }
    void* createData() override { return new Message; }
    void deleteData(void* data) override { delete static_cast<Message*>(data); }
    bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }

private:
    std::string kind;
};

// What both sides make of a number; the Rust of the tests makes the same.
static Message make(const std::string& kind, int number, uint32_t side) {
    Message m;
    m.sec = number;
    m.nanosec = 5;
    m.frame = "base_" + kind;
    if (kind == "scan") {
        for (int i = 0; i < 360; i++) m.floats.push_back(static_cast<float>(i + number) * 0.25f);
    } else if (kind == "cloud") {
        m.width = side, m.height = side, m.step = 16;
        m.bytes.resize(size_t(side) * side * 16);
    } else if (kind == "image") {
        m.width = side, m.height = side, m.step = side * 3;
        m.bytes.resize(size_t(side) * side * 3);
    } else if (kind == "grid") {
        m.width = side, m.height = side;
        m.bytes.resize(size_t(side) * side);
    } else {
        m.child = "child";
        m.x = number * 0.5;
    }
    for (size_t i = 0; i < m.bytes.size(); i++) m.bytes[i] = static_cast<uint8_t>((i + number) % 101);
    return m;
}

static std::string tell(const std::string& kind, const Message& m) {
    double floats = 0;
    uint64_t bytes = 0;
    for (float value : m.floats) floats += value;
    for (uint8_t value : m.bytes) bytes += value;
    return kind + " " + std::to_string(m.sec) + " " + m.frame + " " + std::to_string(m.width) + "x" +
           std::to_string(m.height) + " " + std::to_string(m.floats.size() + m.bytes.size()) + " " +
           std::to_string(static_cast<int64_t>(floats) + static_cast<int64_t>(bytes) +
                          static_cast<int64_t>(m.x * 1000));
}

static DomainParticipant* participant;

static Topic* topic_of(const std::string& kind, const std::string& name) {
    TypeSupport type(new Type(kind));
    type.register_type(participant);
    return participant->create_topic(name, type.get_type_name(), TOPIC_QOS_DEFAULT);
}

// Writes as soon as somebody is known to hear it, from the very thread that finds out.
class Hasty : public DataWriterListener {
public:
    explicit Hasty(const std::string& of) : kind(of) {}
    void on_publication_matched(DataWriter* writer, const PublicationMatchedStatus& matched) override {
        if (matched.current_count_change <= 0) return;
        Message message = make(kind, 0, 100);
        writer->write(&message);
    }

private:
    std::string kind;
};

static DataWriter* writer_of(const std::string& kind, const std::string& name, bool latched,
                             DataWriterListener* listener = nullptr) {
    DataWriterQos qos = DATAWRITER_QOS_DEFAULT;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.reliability().max_blocking_time = eprosima::fastrtps::Duration_t(2, 0);
    qos.durability().kind = latched ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
    qos.history().depth = latched ? 1 : 10;
    qos.endpoint().history_memory_policy =
        eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    // Who writes as soon as it may has no thread in between.
    qos.publish_mode().kind = listener ? SYNCHRONOUS_PUBLISH_MODE : ASYNCHRONOUS_PUBLISH_MODE;
    return participant->create_publisher(PUBLISHER_QOS_DEFAULT)
        ->create_datawriter(topic_of(kind, name), qos, listener);
}

static DataReader* reader_of(const std::string& kind, const std::string& name, bool latched) {
    DataReaderQos qos = DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = latched ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
    qos.history().depth = latched ? 1 : 10;
    qos.endpoint().history_memory_policy =
        eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return participant->create_subscriber(SUBSCRIBER_QOS_DEFAULT)
        ->create_datareader(topic_of(kind, name), qos);
}

static bool take(DataReader* reader, Message& message, SampleInfo& info) {
    message = Message{};
    return reader->take_next_sample(&message, &info) == ReturnCode_t::RETCODE_OK && info.valid_data;
}

static void pause(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

int main(int count, char** words) {
    std::vector<std::string> args(words + 1, words + count);
    if (args.size() < 4) return 2;
    // What Fast DDS itself complains of (a port of shared memory that another one left locked, say)
    // must not stand between the lines that the tests read.
    auto log = std::make_unique<StdoutErrConsumer>();
    log->stderr_threshold(Log::Kind::Info);
    Log::ClearConsumers();
    Log::RegisterConsumer(std::move(log));
    DomainParticipantQos qos = PARTICIPANT_QOS_DEFAULT;
    qos.name("fast");
    participant = DomainParticipantFactory::get_instance()->create_participant(
        static_cast<uint32_t>(std::stoi(args[0])), qos);
    if (participant == nullptr) return 3;
    const std::string verb = args[1];
    const bool latched = args.back() == "latched";
    if (verb == "pub") {
        DataWriter* writer = writer_of(args[2], args[3], latched);
        const int samples = std::stoi(args[4]), period_ms = std::stoi(args[5]);
        const uint32_t side = args.size() > 6 && !latched ? std::stoi(args[6]) : latched ? 4000 : 100;
        PublicationMatchedStatus matched;
        do {
            pause(5);
            writer->get_publication_matched_status(matched);
        } while (!latched && matched.current_count == 0);
        pause(500);  // The other end may find us later than we found it.
        for (int i = 0; i < samples; i++) {
            Message message = make(args[2], i, side);
            writer->write(&message);
            pause(period_ms);
        }
        std::cout << "done" << std::endl;
        std::string line;
        std::getline(std::cin, line);
    } else if (verb == "hasty") {
        Hasty hasty(args[2]);
        for (int i = 0; i < std::stoi(args[4]); i++)
            writer_of(args[2], args[3] + std::to_string(i), false, &hasty);
        std::string line;
        std::getline(std::cin, line);
    } else if (verb == "sub") {
        const auto start = std::chrono::steady_clock::now();
        DataReader* reader = reader_of(args[2], args[3], latched);
        for (int left = std::stoi(args[4]); left > 0;) {
            Message message;
            SampleInfo info;
            if (!take(reader, message, info)) {
                pause(1);
                continue;
            }
            const auto took = std::chrono::steady_clock::now() - start;
            const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(took).count();
            std::cout << tell(args[2], message) << (latched ? " " + std::to_string(ms) : "") << std::endl;
            left--;
        }
    } else if (verb == "serve") {
        DataReader* requests = reader_of("request", "rq" + args[2] + "Request", false);
        DataWriter* replies = writer_of("response", "rr" + args[2] + "Reply", false);
        for (int left = std::stoi(args[3]); left > 0;) {
            Message message;
            SampleInfo info;
            if (!take(requests, message, info)) {
                pause(1);
                continue;
            }
            // As rmw_fastrtps: where the answer goes, and the number of the question.
            eprosima::fastrtps::rtps::WriteParams params;
            params.related_sample_identity() = info.sample_identity;
            const auto& reader = info.related_sample_identity.writer_guid();
            if (reader != eprosima::fastrtps::rtps::GUID_t::unknown())
                params.related_sample_identity().writer_guid(reader);
            Message response;
            response.success = true;
            response.frame = "from fast";
            replies->write(&response, params);
            left--;
        }
        std::cout << "done" << std::endl;
        std::string line;
        std::getline(std::cin, line);
    } else if (verb == "call") {
        DataWriter* requests = writer_of("request", "rq" + args[2] + "Request", false);
        DataReader* replies = reader_of("response", "rr" + args[2] + "Reply", false);
        PublicationMatchedStatus matched;
        SubscriptionMatchedStatus heard;
        do {
            pause(5);
            requests->get_publication_matched_status(matched);
            replies->get_subscription_matched_status(heard);
        } while (matched.current_count == 0 || heard.current_count == 0);
        for (int left = std::stoi(args[3]); left > 0; left--) {
            Message request;
            eprosima::fastrtps::rtps::WriteParams params;
            params.related_sample_identity().writer_guid() = replies->guid();
            requests->write(&request, params);
            Message answer;
            SampleInfo info;
            while (!take(replies, answer, info)) pause(1);
            const auto& related = info.related_sample_identity;
            const bool mine = related.writer_guid() == replies->guid() &&
                              related.sequence_number() == params.sample_identity().sequence_number();
            std::cout << "answer " << answer.success << " " << answer.frame << (mine ? "" : " NOT MINE")
                      << std::endl;
        }
    }
    return 0;
}
