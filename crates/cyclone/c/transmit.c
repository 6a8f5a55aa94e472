/* Cyclone's `ddsi_transmit.c`, with one thing more in the packets: the inline QoS that tells to which
   request a sample is the answer, as Fast DDS wants it. Every sample's parameters end with a call of
   `ddsi_xmsg_addpar_sentinel_ifparam` where `serdata` is at hand, so the sources stay as they are.
   Should that change, this does not compile, or the test `answers_name_their_request` fails. */
#include "ddsi__xmsg.h"

struct ddsi_serdata;
int pp_finish_inline_qos(struct ddsi_xmsg *message, const struct ddsi_serdata *data);

#define ddsi_xmsg_addpar_sentinel_ifparam(message) pp_finish_inline_qos((message), serdata)
#include "ddsi_transmit.c"
