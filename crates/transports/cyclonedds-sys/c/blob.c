/* The type of topics whose samples are bytes: a `ddsi_sertype` and `ddsi_serdata` of our own.
   ROS 2 has no keys, so all samples of a topic are of one instance. */
#include <stdio.h>
#include <string.h>

#include "dds/ddsi/ddsi_domaingv.h"
#include "dds/ddsi/ddsi_keyhash.h"
#include "dds/ddsi/ddsi_radmin.h"
#include "dds/ddsi/ddsi_guid.h"
#include "dds/ddsrt/heap.h"
#include "dds/ddsrt/time.h"
#include "ddsi__misc.h"
#include "ddsi__protocol.h"
#include "ddsi__xmsg.h"

#include "blob.h"

/* RTPS, inline QoS: to which request a sample is the answer. The number is the one that OMG gave
   later; Fast DDS sends both. Source: rmw_fastrtps and DDS-RPC 1.0, 7.8.2. */
#define PID_RELATED_SAMPLE_IDENTITY 0x0083u
#define PID_RELATED_SAMPLE_IDENTITY_OF_EPROSIMA 0x800fu
#define PID_SENTINEL 0x0001u

static uint32_t u32(const uint8_t *at, bool is_little) {
  return is_little
             ? (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24
             : (uint32_t)at[3] | (uint32_t)at[2] << 8 | (uint32_t)at[1] << 16 | (uint32_t)at[0] << 24;
}

static uint16_t u16(const uint8_t *at, bool is_little) {
  return (uint16_t)(is_little ? at[0] | at[1] << 8 : at[1] | at[0] << 8);
}

/* The high half first, whatever the order of bytes in each half (RTPS 2.5, 9.4.2.5). */
static int64_t sequence_number(const uint8_t *at, bool is_little) {
  return (int64_t)((uint64_t)u32(at, is_little) << 32 | u32(at + 4, is_little));
}

/* Looks for the related sample in an inline QoS that ends before `end`. */
static void find_related(struct pp_blob *blob, const uint8_t *at, const uint8_t *end, bool is_little) {
  while (end - at >= 4) {
    const uint16_t id = u16(at, is_little);
    const uint16_t length = u16(at + 2, is_little);
    at += 4;
    if (id == PID_SENTINEL || length > end - at)
      return;
    if ((id == PID_RELATED_SAMPLE_IDENTITY || id == PID_RELATED_SAMPLE_IDENTITY_OF_EPROSIMA) && length >= 24) {
      memcpy(blob->related.guid, at, 16);
      blob->related.sequence = sequence_number(at + 16, is_little);
      blob->has_related = true;
      return;
    }
    at += length;
  }
}

/* Reads in the packet who wrote a sample, of which vendor, and what it answers. By now Cyclone has
   checked the submessage and turned its numbers and the packet's prefix to host order in place; the
   inline QoS is as it came. */
static void find_source(struct pp_blob *blob, const struct ddsi_rdata *first) {
  if (DDSI_RDATA_SUBMSG_OFF(first) == 0)
    return;
  const uint8_t *packet = DDSI_RMSG_PAYLOAD(first->rmsg);
  const ddsi_rtps_header_t *header = (const ddsi_rtps_header_t *)packet;
  const ddsi_rtps_data_datafrag_common_t *data =
      (const ddsi_rtps_data_datafrag_common_t *)(packet + DDSI_RDATA_SUBMSG_OFF(first));
  if (data->smhdr.submessageId != DDSI_RTPS_SMID_DATA &&
      data->smhdr.submessageId != DDSI_RTPS_SMID_DATA_FRAG)
    return;
  const ddsi_guid_prefix_t prefix = ddsi_hton_guid_prefix(header->guid_prefix);
  const ddsi_entityid_t entity = ddsi_hton_entityid(data->writerId);
  memcpy(blob->vendor, &header->vendorid, 2);
  memcpy(blob->writer.guid, &prefix, 12);
  memcpy(blob->writer.guid + 12, &entity, 4);
  blob->writer.sequence = (int64_t)ddsi_from_seqno(data->writerSN);
  blob->has_writer = true;
  if (data->smhdr.flags & DDSI_DATA_FLAG_INLINE_QOS) {
    const bool is_little = (data->smhdr.flags & DDSI_RTPS_SUBMESSAGE_FLAG_ENDIANNESS) != 0;
    const uint8_t *at = (const uint8_t *)&data->octetsToInlineQos + 2 + data->octetsToInlineQos;
    find_related(blob, at, packet + DDSI_RDATA_PAYLOAD_OFF(first), is_little);
  }
}

/* The type. */

static void type_free(struct ddsi_sertype *type) {
  ddsi_sertype_fini(type);
  ddsrt_free(type);
}

static void type_zero_samples(const struct ddsi_sertype *type, void *samples, size_t count) {
  (void)type;
  (void)samples;
  (void)count;
}

/* Only reads and writes of values come here, and only bytes are read and written. */
static void type_realloc_samples(void **samples, const struct ddsi_sertype *type, void *old,
                                 size_t old_count, size_t count) {
  (void)type;
  (void)old;
  (void)old_count;
  for (size_t i = 0; i < count; i++)
    samples[i] = NULL;
}

static void type_free_samples(const struct ddsi_sertype *type, void **samples, size_t count,
                              dds_free_op_t op) {
  (void)type;
  (void)samples;
  (void)count;
  (void)op;
}

/* Name and functions, which are all there is, have been compared before. */
static bool type_equal(const struct ddsi_sertype *a, const struct ddsi_sertype *b) {
  (void)a;
  (void)b;
  return true;
}

static uint32_t type_hash(const struct ddsi_sertype *type) {
  (void)type;
  return 0;
}

static const struct ddsi_sertype_ops type_ops = {
    .version = ddsi_sertype_v0,
    .free = type_free,
    .zero_samples = type_zero_samples,
    .realloc_samples = type_realloc_samples,
    .free_samples = type_free_samples,
    .equal = type_equal,
    .hash = type_hash,
};

struct ddsi_sertype *pp_blob_type(const char *name) {
  struct ddsi_sertype *type = ddsrt_calloc(1, sizeof(*type));
  const dds_data_type_properties_t properties = 0;
  /* ROS 2 speaks CDR version 1. */
  ddsi_sertype_init_props(type, name, &type_ops, &pp_blob_ops, 0, properties,
                          DDS_DATA_REPRESENTATION_FLAG_XCDR1, DDSI_SERTYPE_FLAG_TOPICKIND_NO_KEY);
  return type;
}

/* The samples. */

static const struct pp_blob *blob_of(const struct ddsi_serdata *data) {
  return (const struct pp_blob *)data;
}

struct pp_blob *pp_blob_new(const struct ddsi_sertype *type, enum ddsi_serdata_kind kind) {
  struct pp_blob *blob = ddsrt_calloc(1, sizeof(*blob));
  ddsi_serdata_init(&blob->c, type, kind);
  return blob;
}

static void data_free(struct ddsi_serdata *data) {
  struct pp_blob *blob = (struct pp_blob *)data;
  if (blob->owner)
    pp_hooks.owner_free(blob->owner);
  else if (blob->bytes)
    pp_hooks.buffer_free(blob->bytes, blob->size);
  ddsrt_free(blob);
}

static bool data_eqkey(const struct ddsi_serdata *a, const struct ddsi_serdata *b) {
  (void)a;
  (void)b;
  return true;
}

static uint32_t data_size(const struct ddsi_serdata *data) {
  return (uint32_t)blob_of(data)->size;
}

/* A sample with room for `size` bytes; NULL where there is no memory, and then the sample is lost. */
static struct pp_blob *blob_with_room(const struct ddsi_sertype *type, enum ddsi_serdata_kind kind,
                                      size_t size) {
  uint8_t *bytes = pp_hooks.buffer_new(size);
  if (bytes == NULL)
    return NULL;
  struct pp_blob *blob = pp_blob_new(type, kind);
  blob->bytes = bytes;
  blob->size = size;
  return blob;
}

/* Fragments are in order of their beginnings, and may overlap. */
static struct ddsi_serdata *data_from_ser(const struct ddsi_sertype *type,
                                          enum ddsi_serdata_kind kind,
                                          const struct ddsi_rdata *fragment, size_t size) {
  struct pp_blob *blob = blob_with_room(type, kind, size);
  if (blob == NULL)
    return NULL;
  find_source(blob, fragment);
  size_t done = 0;
  for (; fragment != NULL; fragment = fragment->nextfrag) {
    if (fragment->min > done || fragment->maxp1 > size)
      break;
    if (fragment->maxp1 > done) {
      const uint8_t *from = DDSI_RMSG_PAYLOADOFF(fragment->rmsg, DDSI_RDATA_PAYLOAD_OFF(fragment));
      memcpy(blob->bytes + done, from + (done - fragment->min), fragment->maxp1 - done);
      done = fragment->maxp1;
    }
  }
  if (done != size) {
    ddsi_serdata_unref(&blob->c);
    return NULL;
  }
  return &blob->c;
}

static struct ddsi_serdata *data_from_ser_iov(const struct ddsi_sertype *type,
                                              enum ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                                              const ddsrt_iovec_t *parts, size_t size) {
  struct pp_blob *blob = blob_with_room(type, kind, size);
  if (blob == NULL)
    return NULL;
  size_t done = 0;
  for (ddsrt_msg_iovlen_t i = 0; i < count && done < size; i++) {
    const size_t left = size - done;
    const size_t length = parts[i].iov_len < left ? parts[i].iov_len : left;
    memcpy(blob->bytes + done, parts[i].iov_base, length);
    done += length;
  }
  memset(blob->bytes + done, 0, size - done);
  return &blob->c;
}

static struct ddsi_serdata *data_from_keyhash(const struct ddsi_sertype *type,
                                              const struct ddsi_keyhash *hash) {
  (void)hash;
  return &pp_blob_new(type, SDK_KEY)->c;
}

static struct ddsi_serdata *data_from_sample(const struct ddsi_sertype *type,
                                             enum ddsi_serdata_kind kind, const void *sample) {
  (void)sample;
  return kind == SDK_KEY ? &pp_blob_new(type, SDK_KEY)->c : NULL;
}

static struct ddsi_serdata *data_to_untyped(const struct ddsi_serdata *data) {
  struct pp_blob *key = pp_blob_new(data->type, SDK_KEY);
  key->c.type = NULL;
  key->c.hash = data->hash;
  return &key->c;
}

/* Bytes from `at` on, and zeros behind the last: what is sent is a multiple of four long. */
static void data_to_ser(const struct ddsi_serdata *data, size_t at, size_t size, void *out) {
  const struct pp_blob *blob = blob_of(data);
  const size_t there = at < blob->size ? blob->size - at : 0;
  const size_t length = size < there ? size : there;
  if (length > 0)
    memcpy(out, blob->bytes + at, length);
  memset((uint8_t *)out + length, 0, size - length);
}

/* Whether this thread has just made a fragment that is not the first of its sample. */
static _Thread_local bool has_fragment;

static bool reaches_behind(const struct pp_blob *blob, size_t at, size_t size) {
  return blob->size < at + size;
}

/* Sends the bytes where they are. Only the last fragment is copied when its padding is not there:
   whoever owns the bytes owes us none behind them. */
static struct ddsi_serdata *data_to_ser_ref(const struct ddsi_serdata *data, size_t at, size_t size,
                                            ddsrt_iovec_t *out) {
  const struct pp_blob *blob = blob_of(data);
  has_fragment = at > 0;
  out->iov_len = (ddsrt_iov_len_t)size;
  if (reaches_behind(blob, at, size)) {
    out->iov_base = ddsrt_malloc(size);
    data_to_ser(data, at, size, out->iov_base);
  } else {
    out->iov_base = blob->bytes + at;
  }
  return ddsi_serdata_ref(data);
}

static void data_to_ser_unref(struct ddsi_serdata *data, const ddsrt_iovec_t *part) {
  const struct pp_blob *blob = blob_of(data);
  const uintptr_t from = (uintptr_t)part->iov_base, own = (uintptr_t)blob->bytes;
  if (blob->bytes == NULL || from < own || own + blob->size <= from)
    ddsrt_free(part->iov_base);
  ddsi_serdata_unref(data);
}

static bool data_to_sample(const struct ddsi_serdata *data, void *sample, void **next, void *end) {
  (void)data;
  (void)sample;
  (void)next;
  (void)end;
  return false;
}

static bool data_untyped_to_sample(const struct ddsi_sertype *type, const struct ddsi_serdata *data,
                                   void *sample, void **next, void *end) {
  (void)type;
  return data_to_sample(data, sample, next, end);
}

static size_t data_print(const struct ddsi_sertype *type, const struct ddsi_serdata *data, char *out,
                         size_t size) {
  const int length =
      snprintf(out, size, "%s: %zu bytes", type ? type->type_name : "?", blob_of(data)->size);
  return length < 0 ? 0 : (size_t)length;
}

static void data_get_keyhash(const struct ddsi_serdata *data, struct ddsi_keyhash *hash,
                             bool force_md5) {
  (void)data;
  (void)force_md5;
  memset(hash->value, 0, sizeof(hash->value));
}

const struct ddsi_serdata_ops pp_blob_ops = {
    .eqkey = data_eqkey,
    .get_size = data_size,
    .from_ser = data_from_ser,
    .from_ser_iov = data_from_ser_iov,
    .from_keyhash = data_from_keyhash,
    .from_sample = data_from_sample,
    .to_ser = data_to_ser,
    .to_ser_ref = data_to_ser_ref,
    .to_ser_unref = data_to_ser_unref,
    .to_sample = data_to_sample,
    .to_untyped = data_to_untyped,
    .untyped_to_sample = data_untyped_to_sample,
    .free = data_free,
    .print = data_print,
    .get_keyhash = data_get_keyhash,
};

/* How long a sender pauses between fragments; the system makes some 60 us of it. */
#define PAUSE_NS 10000

/* What transmit.c puts into packets, with no lock held. */
int pp_add_to_packet(struct ddsi_xpack *packet, struct ddsi_xmsg *message, uint32_t flags) {
  const int result = ddsi_xpack_addmsg(packet, message, flags);
  if (has_fragment) {
    has_fragment = false;
    dds_sleepfor(PAUSE_NS);
  }
  return result;
}

/* What transmit.c adds to the inline QoS of a sample. */
int pp_finish_inline_qos(struct ddsi_xmsg *message, const struct ddsi_serdata *data) {
  if (data->ops == &pp_blob_ops && blob_of(data)->has_related) {
    const struct pp_identity *related = &blob_of(data)->related;
    const uint16_t ids[] = {PID_RELATED_SAMPLE_IDENTITY, PID_RELATED_SAMPLE_IDENTITY_OF_EPROSIMA};
    for (size_t i = 0; i < sizeof(ids) / sizeof(ids[0]); i++) {
      uint8_t *out = ddsi_xmsg_addpar(message, ids[i], 24);
      const int32_t high = (int32_t)(related->sequence >> 32);
      const uint32_t low = (uint32_t)related->sequence;
      memcpy(out, related->guid, 16);
      memcpy(out + 16, &high, 4);
      memcpy(out + 20, &low, 4);
    }
  }
  return ddsi_xmsg_addpar_sentinel_ifparam(message);
}
