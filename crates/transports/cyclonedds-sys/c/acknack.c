/* Cyclone's `ddsi_acknack.c` with one change: the pre-emptive ACKNACK by which a new reader asks a writer
   for a heartbeat. Cyclone sends it with the base 1 and the count 0, and Fast DDS ignores an ACKNACK
   whose count is not above the last one, which is 0 at first (`ReaderProxy::check_and_set_acknack_count`
   there). So a reader learned of the samples that Fast DDS keeps for latecomers only with its periodic
   heartbeat, up to 3 s later: `ros_discovery_info`, latched maps. A writer of another vendor now gets what
   Fast DDS itself sends, the base 0 and a count that rises. The sources stay as published: the change is
   made where DDS Security, which is not built in, would encode the submessage.

   And the ACKNACK is repeated every 100 ms, not every second, for the first 10 s: the first one mostly
   arrives before the writer's side has discovered the reader. */
#include "ddsi__vendor.h"
#include "ddsi__xmsg.h"
#include "ddsi__misc.h"
#include "ddsi__protocol.h"
#include "ddsi__endpoint_match.h"
#include "dds/ddsi/ddsi_proxy_endpoint.h"

#include "ddsi__security_omg.h"

static void pp_number_preemptive(struct ddsi_xmsg *message, struct ddsi_xmsg_marker marker,
                                 const struct ddsi_proxy_writer *writer,
                                 struct ddsi_pwr_rd_match *match) {
  ddsi_rtps_acknack_t *acknack = ddsi_xmsg_submsg_from_marker(message, marker);
  if (ddsi_vendor_is_eclipse(writer->c.vendor) ||
      acknack->smhdr.submessageId != DDSI_RTPS_SMID_ACKNACK || acknack->readerSNState.numbits != 0)
    return;
  ddsi_count_t *const count =
      (ddsi_count_t *)((char *)acknack + offsetof(ddsi_rtps_acknack_t, bits));
  if (*count != 0)
    return;
  if (match->count == 0)
    match->count = 1;
  acknack->readerSNState.bitmap_base = ddsi_to_seqno(0);
  *count = match->count++;
}

#define ddsi_security_encode_datareader_submsg(message, marker, writer, reader) \
  (pp_number_preemptive((message), (marker), (writer),                          \
                        (struct ddsi_pwr_rd_match *)rwn),                          \
   ddsi_security_encode_datareader_submsg((message), (marker), (writer), (reader)))
#undef DDS_SECS
#define DDS_SECS(n) ((n) == 1 ? DDS_MSECS(100) : (n) * DDS_NSECS_IN_SEC)
#include "ddsi_acknack.c"
