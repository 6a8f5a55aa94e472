#include "shim.h"

#include <stdbool.h>
#include <string.h>

#include "dds/dds.h"
#include "dds/ddsi/ddsi_domaingv.h"
#include "dds/ddsi/ddsi_entity_index.h"
#include "dds/ddsi/ddsi_endpoint.h"
#include "dds/ddsi/ddsi_guid.h"
#include "dds/ddsi/ddsi_proxy_endpoint.h"
#include "dds/ddsi/ddsi_proxy_participant.h"
#include "dds/ddsi/ddsi_thread.h"
#include "dds/ddsrt/heap.h"
#include "dds/ddsrt/ifaddrs.h"
#include "dds/ddsrt/log.h"
#include "dds/ddsrt/sync.h"
#include "dds__entity.h"
#include "dds__guid.h"
#include "dds__types.h"
#include "dds__writer.h"
#include "ddsi__whc.h"

#include "blob.h"

struct pp_hooks pp_hooks;

size_t pp_size_of(int which) {
  switch (which) {
  case 0:
    return sizeof(struct pp_identity);
  case 1:
    return sizeof(struct pp_qos);
  case 2:
    return sizeof(struct pp_sample);
  case 3:
    return sizeof(struct pp_found);
  default:
    return 0;
  }
}

static void on_log(void *context, const dds_log_data_t *data) {
  (void)context;
  pp_hooks.log(data->priority, data->message);
}

void pp_init(const struct pp_hooks *hooks) {
  pp_hooks = *hooks;
  dds_set_log_sink(on_log, NULL);
}

const char *pp_error(int32_t code) { return dds_strretcode(code); }

int32_t pp_has_network(void) {
  const int families[] = {AF_INET, DDSRT_AF_TERM};
  ddsrt_ifaddrs_t *interfaces = NULL;
  int32_t has = 0;
  if (ddsrt_getifaddrs(&interfaces, families) != DDS_RETCODE_OK)
    return 0;
  for (const ddsrt_ifaddrs_t *one = interfaces; one != NULL; one = one->next)
    has |= one->addr != NULL && (one->flags & IFF_UP) && !(one->flags & IFF_LOOPBACK);
  ddsrt_freeifaddrs(interfaces);
  return has;
}

int32_t pp_domain(uint32_t id, const char *config) { return dds_create_domain(id, config); }

int32_t pp_participant(uint32_t domain, const uint8_t *user_data, size_t size) {
  dds_qos_t *qos = dds_create_qos();
  dds_qset_userdata(qos, user_data, size);
  const dds_entity_t participant = dds_create_participant(domain, qos, NULL);
  dds_delete_qos(qos);
  return participant;
}

int32_t pp_topic(int32_t participant, const char *name, const char *type_name) {
  struct ddsi_sertype *type = pp_blob_type(type_name);
  const dds_entity_t topic = dds_create_topic_sertype(participant, name, &type, NULL, NULL, NULL);
  if (topic < 0)
    ddsi_sertype_unref(type);
  return topic;
}

static dds_duration_t span(int64_t ns) { return ns == INT64_MAX ? DDS_INFINITY : ns; }

static dds_qos_t *to_dds(const struct pp_qos *from, const uint8_t *user_data, size_t size) {
  dds_qos_t *qos = dds_create_qos();
  const dds_history_kind_t history =
      from->history == 1 ? DDS_HISTORY_KEEP_ALL : DDS_HISTORY_KEEP_LAST;
  dds_qset_reliability(qos, (dds_reliability_kind_t)from->reliability, span(from->blocking_ns));
  dds_qset_durability(qos, (dds_durability_kind_t)from->durability);
  dds_qset_history(qos, history, from->depth);
  /* How much a writer keeps for latecomers. */
  if (from->durability > DDS_DURABILITY_VOLATILE)
    dds_qset_durability_service(qos, 0, history, from->depth, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  dds_qset_deadline(qos, span(from->deadline_ns));
  dds_qset_liveliness(qos, (dds_liveliness_kind_t)from->liveliness, span(from->lease_ns));
  /* Samples go and come over the network only: who is in the same program hears another way. */
  dds_qset_ignorelocal(qos, DDS_IGNORELOCAL_PARTICIPANT);
  dds_qset_writer_data_lifecycle(qos, false);
  dds_qset_userdata(qos, user_data, size);
  return qos;
}

static bool is_addressed_to(const struct ddsi_serdata *data, const ddsi_guid_prefix_t *prefix) {
  const struct pp_blob *blob = (const struct pp_blob *)data;
  return data->ops != &pp_blob_ops || !blob->has_destination ||
         memcmp(&blob->destination, prefix, sizeof(*prefix)) == 0;
}

static int filter(struct ddsi_writer *writer, struct ddsi_proxy_reader *reader,
                  struct ddsi_serdata *data) {
  (void)writer;
  return is_addressed_to(data, &reader->e.guid.prefix);
}

/* match.c calls this for every pair of a writer and a remote reader. */
bool pp_set_filter(const struct ddsi_writer *writer, struct ddsi_proxy_reader *reader) {
  if (writer->type != NULL && writer->type->serdata_ops == &pp_blob_ops) {
    ddsrt_mutex_lock(&reader->e.lock);
    reader->filter = filter;
    ddsrt_mutex_unlock(&reader->e.lock);
  }
  return true;
}

int32_t pp_writer(int32_t participant, int32_t topic, const struct pp_qos *settings,
                  const uint8_t *user_data, size_t size) {
  dds_qos_t *qos = to_dds(settings, user_data, size);
  dds_qset_lifespan(qos, span(settings->lifespan_ns));
  const dds_entity_t writer = dds_create_writer(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  return writer;
}

int32_t pp_reader(int32_t participant, int32_t topic, const struct pp_qos *settings,
                  const uint8_t *user_data, size_t size) {
  dds_qos_t *qos = to_dds(settings, user_data, size);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  return reader;
}

int32_t pp_delete(int32_t entity) { return dds_delete(entity); }

int32_t pp_guid(int32_t entity, uint8_t *out) {
  dds_guid_t guid;
  const dds_return_t code = dds_get_guid(entity, &guid);
  if (code >= 0)
    memcpy(out, guid.v, sizeof(guid.v));
  return code;
}

/* Whether a sample would go without waiting: what `write_sample` of Cyclone's `ddsi_transmit.c` asks. */
static bool has_room(struct ddsi_writer *writer) {
  struct ddsi_whc_state state;
  ddsrt_mutex_lock(&writer->e.lock);
  ddsi_whc_get_state(writer->whc, &state);
  const bool has = state.unacked_bytes <= writer->whc_high;
  ddsrt_mutex_unlock(&writer->e.lock);
  return has;
}

int32_t pp_write(int32_t writer, const uint8_t *bytes, size_t size, void *owner,
                 const struct pp_identity *related, int32_t waits, int64_t *sequence) {
  dds_entity *entity;
  dds_return_t code = dds_entity_pin(writer, &entity);
  if (code >= 0 && dds_entity_kind(entity) != DDS_KIND_WRITER) {
    dds_entity_unpin(entity);
    code = DDS_RETCODE_ILLEGAL_OPERATION;
  }
  if (code < 0) {
    pp_hooks.owner_free(owner);
    return code;
  }
  const struct dds_writer *own = (const struct dds_writer *)entity;
  if (!waits && !has_room(own->m_wr)) {
    dds_entity_unpin(entity);
    pp_hooks.owner_free(owner);
    return DDS_RETCODE_TIMEOUT;
  }
  struct pp_blob *blob = pp_blob_new(own->m_wr->type, SDK_DATA);
  blob->bytes = (uint8_t *)bytes;
  blob->size = size;
  blob->owner = owner;
  if (related != NULL) {
    blob->related = *related;
    blob->has_related = true;
  }
  code = dds_writecdr(writer, &blob->c);
  /* Who calls lets nobody else write meanwhile. */
  if (sequence != NULL)
    *sequence = (int64_t)own->m_wr->seq;
  dds_entity_unpin(entity);
  return code;
}

/* In transmit.c. */
int pp_write_to(struct ddsi_xpack *packet, struct ddsi_writer *writer, struct ddsi_serdata *serdata,
                const ddsi_guid_prefix_t *to);
bool pp_has_reader_of(const struct ddsi_writer *writer, const ddsi_guid_prefix_t *to);

/* GUIDs cross in the order of bytes on the wire; Cyclone keeps them in host order. */
static ddsi_guid_prefix_t prefix_of(const uint8_t *bytes) {
  ddsi_guid_prefix_t prefix;
  memcpy(&prefix, bytes, sizeof(prefix));
  return ddsi_ntoh_guid_prefix(prefix);
}

int32_t pp_send_to(int32_t writer, const uint8_t *bytes, size_t size, void *owner,
                   const struct pp_identity *related, const uint8_t *prefix, int64_t *sequence) {
  struct dds_writer *own;
  dds_return_t code = dds_writer_lock(writer, &own);
  if (code < 0) {
    pp_hooks.owner_free(owner);
    return code;
  }
  struct pp_blob *blob = pp_blob_new(own->m_wr->type, SDK_DATA);
  blob->bytes = (uint8_t *)bytes;
  blob->size = size;
  blob->owner = owner;
  blob->destination = prefix_of(prefix);
  blob->has_destination = true;
  if (related != NULL) {
    blob->related = *related;
    blob->has_related = true;
  }
  blob->c.statusinfo = 0;
  blob->c.timestamp.v = dds_time();
  struct ddsi_thread_state *const thread = ddsi_lookup_thread_state();
  ddsi_thread_state_awake(thread, &own->m_entity.m_domain->gv);
  code = pp_write_to(own->m_xp, own->m_wr, &blob->c, &blob->destination);
  /* Who calls lets nobody else write meanwhile. */
  if (sequence != NULL)
    *sequence = (int64_t)own->m_wr->seq;
  ddsi_thread_state_asleep(thread);
  dds_writer_unlock(own);
  if (code == DDS_RETCODE_NO_DATA)
    return 0;
  return code < 0 ? code : 1;
}

int32_t pp_reaches(int32_t writer, const uint8_t *bytes) {
  struct dds_writer *own;
  const dds_return_t code = dds_writer_lock(writer, &own);
  if (code < 0)
    return code;
  const ddsi_guid_prefix_t prefix = prefix_of(bytes);
  ddsrt_mutex_lock(&own->m_wr->e.lock);
  const bool reaches = pp_has_reader_of(own->m_wr, &prefix);
  ddsrt_mutex_unlock(&own->m_wr->e.lock);
  dds_writer_unlock(own);
  return reaches;
}

int32_t pp_take(int32_t reader, struct pp_sample *sample) {
  struct ddsi_serdata *data = NULL;
  dds_sample_info_t info;
  const dds_return_t count = dds_takecdr(reader, &data, 1, &info, DDS_ANY_STATE);
  if (count <= 0)
    return count;
  memset(sample, 0, sizeof(*sample));
  struct pp_blob *blob = (struct pp_blob *)data;
  sample->time_ns = info.source_timestamp;
  sample->is_data = info.valid_data && data->kind == SDK_DATA;
  if (sample->is_data) {
    sample->writer = blob->writer;
    sample->related = blob->related;
    sample->has_writer = blob->has_writer;
    sample->has_related = blob->has_related;
    memcpy(sample->vendor, blob->vendor, 2);
    sample->size = blob->size;
    /* Nobody else has it, as a rule; then its bytes change hands. */
    if (blob->owner == NULL && ddsrt_atomic_ld32(&data->refc) == 1) {
      sample->bytes = blob->bytes;
      blob->bytes = NULL;
      blob->size = 0;
    } else {
      sample->bytes = pp_hooks.buffer_new(blob->size);
      if (sample->bytes != NULL)
        memcpy(sample->bytes, blob->bytes, blob->size);
      else
        sample->is_data = 0;
    }
  }
  ddsi_serdata_unref(data);
  return count;
}

int32_t pp_assert_liveliness(int32_t writer) { return dds_assert_liveliness(writer); }

int32_t pp_wait_acknowledged(int32_t writer, int64_t timeout_ns) {
  return dds_wait_for_acks(writer, span(timeout_ns));
}

int32_t pp_matched(int32_t endpoint, int32_t is_writer) {
  if (is_writer) {
    dds_publication_matched_status_t status;
    const dds_return_t code = dds_get_publication_matched_status(endpoint, &status);
    return code < 0 ? code : (int32_t)status.current_count;
  }
  dds_subscription_matched_status_t status;
  const dds_return_t code = dds_get_subscription_matched_status(endpoint, &status);
  return code < 0 ? code : (int32_t)status.current_count;
}

/* Discovery. */

int32_t pp_discovery(int32_t participant, int32_t kind) {
  const dds_entity_t topics[] = {DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, DDS_BUILTIN_TOPIC_DCPSPUBLICATION,
                                 DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION};
  if (kind < 0 || kind > 2)
    return DDS_RETCODE_BAD_PARAMETER;
  return dds_create_reader(participant, topics[kind], NULL, NULL);
}

static void from_dds(const dds_qos_t *qos, struct pp_found *found) {
  struct pp_qos *out = &found->qos;
  out->deadline_ns = out->lifespan_ns = out->lease_ns = out->blocking_ns = INT64_MAX;
  out->history = -1;
  if (qos == NULL)
    return;
  dds_reliability_kind_t reliability;
  dds_durability_kind_t durability;
  dds_history_kind_t history;
  dds_liveliness_kind_t liveliness;
  void *bytes;
  if (dds_qget_reliability(qos, &reliability, &out->blocking_ns))
    out->reliability = (int32_t)reliability;
  if (dds_qget_durability(qos, &durability))
    out->durability = (int32_t)durability;
  if (dds_qget_history(qos, &history, &out->depth))
    out->history = (int32_t)history;
  if (dds_qget_liveliness(qos, &liveliness, &out->lease_ns))
    out->liveliness = (int32_t)liveliness;
  (void)dds_qget_deadline(qos, &out->deadline_ns);
  (void)dds_qget_lifespan(qos, &out->lifespan_ns);
  if (dds_qget_userdata(qos, &bytes, &found->user_data_size))
    found->user_data = bytes;
}

/* The vendor of a participant, as its packets say. */
static void find_vendor(dds_entity_t reader, struct pp_found *found) {
  dds_entity *entity;
  if (dds_entity_pin(reader, &entity) < 0)
    return;
  struct ddsi_domaingv *gv = &entity->m_domain->gv;
  dds_guid_t guid;
  memcpy(guid.v, found->participant, sizeof(guid.v));
  const ddsi_guid_t key = dds_guid_to_ddsi_guid(guid);
  ddsi_thread_state_awake(ddsi_lookup_thread_state(), gv);
  const struct ddsi_proxy_participant *participant =
      ddsi_entidx_lookup_proxy_participant_guid(gv->entity_index, &key);
  if (participant != NULL)
    memcpy(found->vendor, &participant->vendor, 2);
  ddsi_thread_state_asleep(ddsi_lookup_thread_state());
  dds_entity_unpin(entity);
}

int32_t pp_discovery_take(int32_t reader, int32_t kind, struct pp_found *found) {
  void *sample = NULL;
  dds_sample_info_t info;
  memset(found, 0, sizeof(*found));
  const dds_return_t count = dds_take(reader, &sample, &info, 1, 1);
  if (count <= 0)
    return count;
  found->loan = sample;
  found->is_alive = info.instance_state == DDS_IST_ALIVE && info.valid_data;
  if (kind == 0) {
    const dds_builtintopic_participant_t *participant = sample;
    memcpy(found->guid, participant->key.v, 16);
    memcpy(found->participant, participant->key.v, 16);
    if (found->is_alive)
      from_dds(participant->qos, found);
  } else {
    const dds_builtintopic_endpoint_t *endpoint = sample;
    memcpy(found->guid, endpoint->key.v, 16);
    memcpy(found->participant, endpoint->participant_key.v, 16);
    if (found->is_alive) {
      found->topic = endpoint->topic_name;
      found->type = endpoint->type_name;
      from_dds(endpoint->qos, found);
    }
  }
  if (found->is_alive)
    find_vendor(reader, found);
  return count;
}

void pp_discovery_return(int32_t reader, struct pp_found *found) {
  if (found->user_data != NULL)
    dds_free(found->user_data);
  (void)dds_return_loan(reader, &found->loan, 1);
  memset(found, 0, sizeof(*found));
}

/* Waiting. */

int32_t pp_waitset(int32_t participant) { return dds_create_waitset(participant); }

#define WATCHED (DDS_DATA_AVAILABLE_STATUS | DDS_PUBLICATION_MATCHED_STATUS)

int32_t pp_watch(int32_t waitset, int32_t entity, int32_t event) {
  const uint32_t events[] = {0, DDS_DATA_AVAILABLE_STATUS, DDS_PUBLICATION_MATCHED_STATUS};
  if (event < 0 || event > 2)
    return DDS_RETCODE_BAD_PARAMETER;
  if (event != 0) {
    const dds_return_t code = dds_set_status_mask(entity, events[event]);
    if (code < 0)
      return code;
  }
  return dds_waitset_attach(waitset, entity, entity);
}

int32_t pp_wait(int32_t waitset, intptr_t *entities, size_t room, int64_t timeout_ns) {
  const dds_return_t count = dds_waitset_wait(waitset, entities, room, span(timeout_ns));
  for (size_t i = 0; count > 0 && i < (size_t)count && i < room; i++) {
    const dds_entity_t entity = (dds_entity_t)entities[i];
    uint32_t mask = 0, status;
    /* Guards have no status and stay set until they are taken. */
    if (dds_get_status_mask(entity, &mask) >= 0 && (mask & WATCHED) != 0)
      (void)dds_take_status(entity, &status, mask & WATCHED);
  }
  return count;
}

int32_t pp_guard(int32_t participant) { return dds_create_guardcondition(participant); }

int32_t pp_guard_set(int32_t guard, int32_t on) {
  if (on)
    return dds_set_guardcondition(guard, true);
  bool was;
  return dds_take_guardcondition(guard, &was);
}
