// Fast DDS as a publisher and a subscriber that measure. See crates/transports/dds/examples/race/peer.rs for the words:
//
//   wire_fast DOMAIN pub TOPIC TYPE DEPTH TEMPLATE COUNT PERIOD_US
//   wire_fast DOMAIN sub TOPIC TYPE DEPTH
//
// Samples are bytes of TEMPLATE with the time of publication in their header. PEER_TRANSPORT: "udp" or
// the usual ones (shared memory); PEER_BUFFER: receive buffer of sockets in bytes.
#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>

using namespace eprosima::fastdds::dds;
using eprosima::fastdds::rtps::UDPv4TransportDescriptor;
using eprosima::fastrtps::rtps::SerializedPayload_t;
using Bytes = std::vector<char>;

static int64_t unix_ns() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

class Type : public TopicDataType {
public:
    explicit Type(const std::string& name) {
        setName(name.c_str());
        m_typeSize = 1024;
        m_isGetKeyDefined = false;
        auto_fill_type_object(false);
        auto_fill_type_information(false);
    }
    bool serialize(void* data, SerializedPayload_t* payload) override {
        const Bytes& bytes = *static_cast<Bytes*>(data);
        payload->encapsulation = CDR_LE;
        std::memcpy(payload->data, bytes.data(), bytes.size());
        payload->length = static_cast<uint32_t>(bytes.size());
        return true;
    }
    bool deserialize(SerializedPayload_t* payload, void* data) override {
        const char* from = reinterpret_cast<char*>(payload->data);
        static_cast<Bytes*>(data)->assign(from, from + payload->length);
        return true;
    }
    std::function<uint32_t()> getSerializedSizeProvider(void* data) override {
        const size_t size = static_cast<Bytes*>(data)->size();
        return [size] { return static_cast<uint32_t>(size); };
    }
    void* createData() override { return new Bytes; }
    void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
    bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

struct Listener : DataReaderListener {
    std::mutex mutex;
    std::vector<double> latencies_us;
    int64_t first_ns = 0, last_ns = 0;
    Bytes bytes;

    void on_data_available(DataReader* reader) override {
        SampleInfo info;
        while (reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
            if (!info.valid_data || bytes.size() < 12) continue;
            const int64_t now = unix_ns();
            int32_t sec;
            uint32_t nanosec;
            std::memcpy(&sec, bytes.data() + 4, 4);
            std::memcpy(&nanosec, bytes.data() + 8, 4);
            std::lock_guard<std::mutex> lock(mutex);
            latencies_us.push_back(1e-3 * static_cast<double>(now - (int64_t(sec) * 1000000000 + nanosec)));
            if (first_ns == 0) first_ns = now;
            last_ns = now;
        }
    }
};

template <typename Qos>
static void set(Qos& qos, int depth) {
    qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = VOLATILE_DURABILITY_QOS;
    qos.history().kind = KEEP_LAST_HISTORY_QOS;
    qos.history().depth = depth;
    qos.resource_limits().max_samples = std::max(depth, 5000);
    qos.resource_limits().max_samples_per_instance = std::max(depth, 5000);
    qos.endpoint().history_memory_policy =
        eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
}

int main(int count, char** words) {
    const std::vector<std::string> args(words + 1, words + count);
    if (args.size() < 5) return 2;
    DomainParticipantQos qos = PARTICIPANT_QOS_DEFAULT;
    const char* buffer = std::getenv("PEER_BUFFER");
    const char* transport = std::getenv("PEER_TRANSPORT");
    if (buffer != nullptr) qos.transport().listen_socket_buffer_size = std::stoul(buffer);
    if (transport != nullptr && std::string(transport) == "udp") {
        auto udp = std::make_shared<UDPv4TransportDescriptor>();
        if (buffer != nullptr) udp->receiveBufferSize = std::stoul(buffer);
        qos.transport().use_builtin_transports = false;
        qos.transport().user_transports.push_back(udp);
    }
    DomainParticipant* participant = DomainParticipantFactory::get_instance()->create_participant(
        static_cast<uint32_t>(std::stoi(args[0])), qos);
    if (participant == nullptr) return 3;
    TypeSupport type(new Type(args[3]));
    type.register_type(participant);
    Topic* topic = participant->create_topic(args[2], args[3], TOPIC_QOS_DEFAULT);
    std::string line;
    if (args[1] == "pub") {
        DataWriterQos wanted = DATAWRITER_QOS_DEFAULT;
        set(wanted, std::stoi(args[4]));
        wanted.reliability().max_blocking_time = eprosima::fastrtps::Duration_t(0, 100000000);
        wanted.publish_mode().kind = ASYNCHRONOUS_PUBLISH_MODE;
        DataWriter* writer =
            participant->create_publisher(PUBLISHER_QOS_DEFAULT)->create_datawriter(topic, wanted);
        std::ifstream file(args[5], std::ios::binary);
        Bytes bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
        const int samples = std::stoi(args[6]);
        const auto period = std::chrono::microseconds(std::stoi(args[7]));
        PublicationMatchedStatus matched;
        do {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            writer->get_publication_matched_status(matched);
        } while (matched.current_count == 0);
        // The other end may find us later than we found it.
        std::this_thread::sleep_for(std::chrono::milliseconds(700));
        std::cout << "begin" << std::endl;
        auto next = std::chrono::steady_clock::now();
        for (int i = 0; i < samples; i++) {
            const int64_t now = unix_ns();
            const int32_t sec = static_cast<int32_t>(now / 1000000000);
            const uint32_t nanosec = static_cast<uint32_t>(now % 1000000000);
            std::memcpy(bytes.data() + 4, &sec, 4);
            std::memcpy(bytes.data() + 8, &nanosec, 4);
            writer->write(&bytes);
            next += period;
            std::this_thread::sleep_until(next);
        }
        std::cout << "done " << samples << std::endl;
        std::getline(std::cin, line);
    } else {
        DataReaderQos wanted = DATAREADER_QOS_DEFAULT;
        set(wanted, std::stoi(args[4]));
        Listener listener;
        participant->create_subscriber(SUBSCRIBER_QOS_DEFAULT)
            ->create_datareader(topic, wanted, &listener);
        std::cout << "ready" << std::endl;
        std::getline(std::cin, line);
        std::lock_guard<std::mutex> lock(listener.mutex);
        std::cout << "got " << 1e-9 * static_cast<double>(listener.last_ns - listener.first_ns);
        for (double latency : listener.latencies_us) std::cout << " " << latency;
        std::cout << std::endl;
        std::quick_exit(0);
    }
    return 0;
}
