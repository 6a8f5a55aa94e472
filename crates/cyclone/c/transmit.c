/* Cyclone's `ddsi_transmit.c`, with one thing more in the packets: the inline QoS that tells to which
   request a sample is the answer, as Fast DDS wants it. Every sample's parameters end with a call of
   `ddsi_xmsg_addpar_sentinel_ifparam` where `serdata` is at hand, so the sources stay as they are.
   Should that change, this does not compile, or the test `answers_name_their_request` fails.

   And one thing less hastily: between the fragments of a large sample the sender pauses, so that a
   receiver whose socket holds three of them, as kernels have it by themselves, can take one before the
   next comes. What is lost costs far more. */
#include "ddsi__xmsg.h"

struct ddsi_serdata;
int pp_finish_inline_qos(struct ddsi_xmsg *message, const struct ddsi_serdata *data);

int pp_add_to_packet(struct ddsi_xpack *packet, struct ddsi_xmsg *message, uint32_t flags);

#define ddsi_xmsg_addpar_sentinel_ifparam(message) pp_finish_inline_qos((message), serdata)
#define ddsi_xpack_addmsg(packet, message, flags) pp_add_to_packet((packet), (message), (flags))
#include "ddsi_transmit.c"
