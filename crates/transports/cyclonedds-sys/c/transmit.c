/* Cyclone's `ddsi_transmit.c`, with one thing more in the packets: the inline QoS that tells to which
   request a sample is the answer, as Fast DDS wants it. Every sample's parameters end with a call of
   `ddsi_xmsg_addpar_sentinel_ifparam` where `serdata` is at hand, so the sources stay as they are.
   Should that change, this does not compile, or the test `answers_name_their_request` fails.

   And one thing less hastily: between the fragments of a large sample the sender pauses, so that a
   receiver whose socket holds three of them, as kernels have it by themselves, can take one before the
   next comes. What is lost costs far more.

   `pp_write_to` at the end sends a sample to one participant. The forms of a service's requests and
   responses depend on the vendor of the receiver. With one writer for all vendors, a service has as many
   response writers as request readers, which rmw_fastrtps requires of a service that is ready. */
#include "ddsi__xmsg.h"

struct ddsi_serdata;
int pp_finish_inline_qos(struct ddsi_xmsg *message, const struct ddsi_serdata *data);

int pp_add_to_packet(struct ddsi_xpack *packet, struct ddsi_xmsg *message, uint32_t flags);

#define ddsi_xmsg_addpar_sentinel_ifparam(message) pp_finish_inline_qos((message), serdata)
#define ddsi_xpack_addmsg(packet, message, flags) pp_add_to_packet((packet), (message), (flags))
#include "ddsi_transmit.c"

#include "ddsi__entity_index.h"
#include "ddsi__receive.h"

int pp_write_to(struct ddsi_xpack *packet, struct ddsi_writer *writer, struct ddsi_serdata *serdata,
                const ddsi_guid_prefix_t *to);
bool pp_has_reader_of(const struct ddsi_writer *writer, const ddsi_guid_prefix_t *to);

static bool is_reader_of(const struct ddsi_wr_prd_match *match, const ddsi_guid_prefix_t *to) {
  return memcmp(&match->prd_guid.prefix, to, sizeof(*to)) == 0;
}

/* True when a reader of that participant is matched. The caller holds the writer's lock. */
bool pp_has_reader_of(const struct ddsi_writer *writer, const ddsi_guid_prefix_t *to) {
  ddsrt_avl_iter_t it;
  for (const struct ddsi_wr_prd_match *match =
           ddsrt_avl_iter_first(&ddsi_wr_readers_treedef, &writer->readers, &it);
       match != NULL; match = ddsrt_avl_iter_next(&it))
    if (is_reader_of(match, to))
      return true;
  return false;
}

/* Waits for room as `write_sample` does. */
static dds_return_t await_room(struct ddsi_xpack *packet, struct ddsi_writer *writer) {
  struct ddsi_whc_state state;
  ddsi_whc_get_state(writer->whc, &state);
  if (state.unacked_bytes <= writer->whc_high)
    return DDS_RETCODE_OK;
  if (!writer->retransmitting) {
    maybe_grow_whc(writer);
    if (state.unacked_bytes <= writer->whc_high)
      return DDS_RETCODE_OK;
  }
  return throttle_writer(ddsi_lookup_thread_state(), packet, writer);
}

/* Writes a sample for the readers of one participant. They get it; every other reliable reader gets a
   GAP in its place, so that it neither waits for the sample nor asks for it. Keeps no reference to
   `serdata` on failure. DDS_RETCODE_NO_DATA: the participant has no matched reader. */
int pp_write_to(struct ddsi_xpack *packet, struct ddsi_writer *writer, struct ddsi_serdata *serdata,
                const ddsi_guid_prefix_t *to) {
  struct ddsi_domaingv *const gv = writer->e.gv;
  struct ddsi_tkmap_instance *key = ddsi_tkmap_lookup_instance_ref(gv->m_tkmap, serdata);
  ddsi_guid_t *readers = NULL;
  struct ddsi_xmsg **gaps = NULL;
  size_t reader_count = 0, gap_count = 0;

  ddsrt_mutex_lock(&writer->e.lock);
  int code = await_room(packet, writer);
  if (code == DDS_RETCODE_OK && writer->state != WRST_OPERATIONAL)
    code = DDS_RETCODE_PRECONDITION_NOT_MET;
  if (code == DDS_RETCODE_OK && !pp_has_reader_of(writer, to))
    code = DDS_RETCODE_NO_DATA;
  if (code != DDS_RETCODE_OK)
    goto unlock;

  serdata->twrite = ddsrt_time_monotonic();
  const ddsi_seqno_t seq = ++writer->seq;
  writer->sent_bytes += ddsi_serdata_size(serdata);
  code = insert_sample_in_whc(writer, seq, serdata, key);
  if (code < 0)
    goto unlock;
  code = DDS_RETCODE_OK;
  readers = ddsrt_malloc(writer->num_readers * sizeof(*readers));
  gaps = ddsrt_malloc(writer->num_readers * sizeof(*gaps));
  ddsrt_avl_iter_t it;
  for (const struct ddsi_wr_prd_match *match =
           ddsrt_avl_iter_first(&ddsi_wr_readers_treedef, &writer->readers, &it);
       match != NULL; match = ddsrt_avl_iter_next(&it)) {
    if (is_reader_of(match, to)) {
      readers[reader_count++] = match->prd_guid;
      continue;
    }
    struct ddsi_proxy_reader *reader =
        ddsi_entidx_lookup_proxy_reader_guid(gv->entity_index, &match->prd_guid);
    if (reader == NULL || !match->is_reliable)
      continue;
    struct ddsi_gap_info info;
    ddsi_gap_info_init(&info);
    ddsi_gap_info_update(gv, &info, seq);
    gaps[gap_count] = ddsi_gap_info_create_gap(writer, reader, &info);
    gap_count += gaps[gap_count] != NULL;
  }
  ddsrt_mutex_unlock(&writer->e.lock);

  for (size_t i = 0; i < gap_count; i++)
    ddsi_xpack_addmsg(packet, gaps[i], 0);
  for (size_t i = 0; i < reader_count; i++) {
    struct ddsi_proxy_reader *reader =
        ddsi_entidx_lookup_proxy_reader_guid(gv->entity_index, &readers[i]);
    if (reader == NULL)
      continue;
    struct ddsi_whc_state state;
    ddsrt_mutex_lock(&writer->e.lock);
    ddsi_whc_get_state(writer->whc, &state);
    transmit_sample_unlocks_wr(packet, writer, writer->heartbeat_xevent == NULL ? NULL : &state, seq,
                               serdata, reader, 1);
  }
  ddsi_xpack_send(packet, true);
  goto done;

unlock:
  ddsrt_mutex_unlock(&writer->e.lock);
done:
  ddsrt_free(readers);
  ddsrt_free(gaps);
  ddsi_tkmap_instance_unref(gv->m_tkmap, key);
  ddsi_serdata_unref(serdata);
  return code;
}
