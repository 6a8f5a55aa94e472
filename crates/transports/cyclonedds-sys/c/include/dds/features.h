/* What is built in: what ROS 2 asks for, and nothing that needs another library. Types are matched
   by their names, as ROS 2 does; so neither type library nor type discovery. */
#ifndef PERIPLUS_DDS_FEATURES_H
#define PERIPLUS_DDS_FEATURES_H

#define DDS_HAS_LIFESPAN 1
#define DDS_HAS_DEADLINE_MISSED 1
#define DDS_IS_STATIC_LIBRARY 1

#endif
