/* Cyclone's `ddsi_udp.c` with one change: a participant that uses loopback interfaces only binds its
   sockets to loopback, so that other machines cannot reach its ports. Cyclone binds every receiving
   socket to all addresses of the machine. The sources stay as published: the change is a macro over the
   one call of `ddsrt_bind`. */
#ifdef __linux__
#define _GNU_SOURCE /* as the file itself has it, before any header */
#endif
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "dds/ddsi/ddsi_domaingv.h"
#include "dds/ddsrt/sockets.h"
#include "ddsi__ipaddr.h"
#include "ddsi__tran.h"

static bool uses_loopback_only(const struct ddsi_domaingv *gv) {
  for (int i = 0; i < gv->n_interfaces; i++)
    if (!gv->interfaces[i].loopback)
      return false;
  return gv->n_interfaces > 0;
}

#ifdef __linux__
/* A socket bound to the address of a group gets what is sent to that group alone; without
   IP_MULTICAST_ALL only on the interfaces where the socket itself joined. */
static void restrict_to_group(const struct ddsi_domaingv *gv, ddsrt_socket_t sock,
                              struct sockaddr_in *address) {
  const int none = 0;
  if (strcmp(gv->config.spdpMulticastAddressString, "239.255.0.1") == 0 &&
      setsockopt(sock, IPPROTO_IP, IP_MULTICAST_ALL, &none, sizeof(none)) == 0)
    address->sin_addr.s_addr = htonl(0xefff0001u);
}
#endif

static dds_return_t pp_bind(const struct ddsi_domaingv *gv, const struct ddsi_tran_qos *qos,
                            ddsrt_socket_t sock, struct sockaddr *address, socklen_t size) {
  if (address->sa_family == AF_INET && uses_loopback_only(gv)) {
    struct sockaddr_in *own = (struct sockaddr_in *)address;
    if (qos->m_purpose == DDSI_TRAN_QOS_RECV_UC)
      own->sin_addr.s_addr = htonl(INADDR_LOOPBACK);
#ifdef __linux__
    if (qos->m_purpose == DDSI_TRAN_QOS_RECV_MC)
      restrict_to_group(gv, sock, own);
#endif
  }
  return ddsrt_bind(sock, address, size);
}

#define ddsrt_bind(sock, address, size) pp_bind(gv, qos, (sock), (address), (size))
#include "ddsi_udp.c"
